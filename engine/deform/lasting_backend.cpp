#include "engine/deform/lasting_backend.h"

#include <type_traits>

namespace anvil {

namespace {

class LastingSession final : public DeformSession {
  public:
    LastingSession(LastingBackend& backend, std::shared_ptr<const DeformInput> input,
                   std::unique_ptr<DeformSession> on_device)
        : backend_(backend), input_(std::move(input)), on_device_(std::move(on_device)) {}

    void update(const DeformMotion& motion) override {
        moves_ = false;
        lasting([&](DeformSession& session) { session.update(motion); });
        motion_ = motion;
        moves_ = true;
    }
    void wait() override {
        lasting([](DeformSession& session) { session.wait(); });
    }
    std::vector<PointResult> download() override {
        return lasting([](DeformSession& session) { return session.download(); });
    }
    std::vector<Vec3> download_normals() override {
        return lasting([](DeformSession& session) { return session.download_normals(); });
    }
    void refresh_shapes() override {
        lasting([](DeformSession& session) { session.refresh_shapes(); });
    }
    void refresh_occluders() override {
        lasting([](DeformSession& session) { session.refresh_occluders(); });
    }

    DeformSession& now() const { return on_cpu_ ? *on_cpu_ : *on_device_; }

  private:
    template <class Work>
    std::invoke_result_t<Work, DeformSession&> lasting(const Work& work) {
        if (on_cpu_) {
            return work(*on_cpu_);
        }
        try {
            return work(*on_device_);
        } catch (const DeviceError& error) {
            backend_.give_up(error);
        }
        on_cpu_ = backend_.successor()->prepare(input_);
        if (moves_) {
            on_cpu_->update(motion_);
        }
        return work(*on_cpu_);
    }

    LastingBackend& backend_;
    std::shared_ptr<const DeformInput> input_;
    DeformMotion motion_; ///< the last one
    bool moves_ = false;  ///< there has been one
    std::unique_ptr<DeformSession> on_device_;
    std::unique_ptr<DeformSession> on_cpu_; ///< once the device has failed
};

} // namespace

LastingBackend::LastingBackend(Backend& device, Log& log) : device_(device), log_(log) {}

LastingBackend::LastingBackend(std::unique_ptr<Backend> device, Log& log)
    : own_(std::move(device)), device_(*own_), log_(log) {}

std::unique_ptr<DeformSession> LastingBackend::prepare(std::shared_ptr<const DeformInput> input) {
    if (!cpu_) {
        try {
            return std::make_unique<LastingSession>(*this, input, device_.prepare(input));
        } catch (const DeviceError& error) {
            give_up(error);
        }
    }
    return cpu_->prepare(std::move(input));
}

void LastingBackend::warm(const DeformInput& input, const DeformMotion& motion) {
    device_.warm(input, motion);
}

SearchDevice* LastingBackend::search_device() {
    if (cpu_ || search_) {
        return cpu_ ? nullptr : &*search_;
    }
    try {
        if (SearchDevice* const device = device_.search_device()) {
            return &search_.emplace(*device, log_);
        }
    } catch (const DeviceError& error) {
        give_up(error);
    }
    return nullptr;
}

std::string LastingBackend::device_name() const {
    return cpu_ ? cpu_->device_name() : device_.device_name();
}

std::string LastingBackend::driver_name() const {
    return cpu_ ? cpu_->driver_name() : device_.driver_name();
}

void LastingBackend::give_up(const DeviceError& error) {
    if (!cpu_) {
        log_.warn(std::string(error.what()) + "; the edit goes on with the CPU");
        cpu_ = make_cpu_backend();
    }
}

const DeformSession& computing(const DeformSession& session) {
    const auto* lasting = dynamic_cast<const LastingSession*>(&session);
    return lasting != nullptr ? lasting->now() : session;
}

} // namespace anvil

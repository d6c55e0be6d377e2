// What the workbench does where its device fails.
#include "app/viewer/workbench.h"

#include "engine/core/error.h"

namespace anvil {

namespace {

/// A device that was lost: each call fails.
class LostBackend final : public Backend {
  public:
    LostBackend(std::string device, std::string driver)
        : device_(std::move(device)), driver_(std::move(driver)) {}

    std::unique_ptr<DeformSession> prepare(std::shared_ptr<const DeformInput> /*input*/) override {
        throw DeviceError("the device was lost");
    }
    std::string device_name() const override { return device_; }
    std::string driver_name() const override { return driver_; }

  private:
    std::string device_;
    std::string driver_;
};

} // namespace

void Workbench::outlasting(Progress& progress, const std::function<void()>& step) {
    const std::string failed = backend_->device_name();
    try {
        step();
        return;
    } catch (const DeviceError& error) {
        auto cpu = make_cpu_backend();
        if (failed == cpu->device_name()) {
            throw;
        }
        log_.warn("device \"" + failed + "\" failed (" + error.what() +
                  "): the CPU goes on with all edits; the Device menu leads back");
        session_.reset();
        backend_ = std::move(cpu);
    }
    document().change_backend(work(progress));
    step();
}

void Workbench::lose_computing() {
    session_.reset();
    backend_ = std::make_shared<LostBackend>(backend_->device_name(), backend_->driver_name());
}

} // namespace anvil

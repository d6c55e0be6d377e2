#include "engine/gpu/gpu_backend.h"

#include "engine/gpu/gpu_session.h"
#include "engine/gpu/search_device.h"

namespace anvil {

namespace {

// A window's pictures wait for what the device is at: on lavapipe, some 300,000 points a second are searched:
// 7 ms.
constexpr uint64_t slow_search_bytes = uint64_t{64} << 10;

class GpuBackend final : public Backend {
  public:
    GpuBackend(std::shared_ptr<Device> device, const GpuBackendOptions& options)
        : device_(device), pipeline_(std::make_shared<DeformPipeline>(std::move(device))), options_(options) {
    }

    std::unique_ptr<DeformSession> prepare(std::shared_ptr<const DeformInput> input) override {
        return std::make_unique<GpuSession>(pipeline_, std::move(input), options_.chunk_bytes);
    }
    void warm(const DeformInput& input, const DeformMotion& motion) override {
        pipeline_->kernel(variant_of(input, motion));
    }
    SearchDevice* search_device() override {
        const bool bakes = options_.baking == DeviceBaking::on_gpus
                               ? pipeline_->info().type != DeviceType::cpu
                               : options_.baking == DeviceBaking::always;
        if (bakes && !search_) {
            SearchDeviceOptions search{.log = options_.log};
            if (pipeline_->info().type == DeviceType::cpu) {
                search.chunk_bytes = slow_search_bytes;
            }
            search_ = make_search_device(device_, search);
        }
        return search_.get();
    }
    std::string device_name() const override { return pipeline_->info().name; }
    std::string driver_name() const override { return pipeline_->info().driver; }

  private:
    std::shared_ptr<Device> device_;
    std::shared_ptr<DeformPipeline> pipeline_;
    std::unique_ptr<SearchDevice> search_; ///< made when it is wanted first
    GpuBackendOptions options_;
};

} // namespace

std::unique_ptr<Backend> make_gpu_backend(std::shared_ptr<Device> device, const GpuBackendOptions& options) {
    return std::make_unique<GpuBackend>(std::move(device), options);
}

} // namespace anvil

#include "engine/gpu/gpu_backend.h"

#include "engine/gpu/gpu_session.h"

namespace anvil {

namespace {

class GpuBackend final : public Backend {
  public:
    GpuBackend(std::shared_ptr<Device> device, const GpuBackendOptions& options)
        : pipeline_(std::make_shared<DeformPipeline>(std::move(device))), options_(options) {}

    std::unique_ptr<DeformSession> prepare(std::shared_ptr<const DeformInput> input) override {
        return std::make_unique<GpuSession>(pipeline_, std::move(input), options_.chunk_bytes);
    }
    void warm(const DeformInput& input, const DeformMotion& motion) override {
        pipeline_->kernel(variant_of(input, motion));
    }
    std::string device_name() const override { return pipeline_->info().name; }
    std::string driver_name() const override { return pipeline_->info().driver; }

  private:
    std::shared_ptr<DeformPipeline> pipeline_;
    GpuBackendOptions options_;
};

} // namespace

std::unique_ptr<Backend> make_gpu_backend(std::shared_ptr<Device> device, const GpuBackendOptions& options) {
    return std::make_unique<GpuBackend>(std::move(device), options);
}

} // namespace anvil

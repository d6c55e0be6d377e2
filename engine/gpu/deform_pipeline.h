// The deformation kernel on a device and the sampled fields it reads, shared by all sessions; internal to
// engine/gpu.
#pragma once

#include "engine/gpu/compute_kernel.h"
#include "engine/occluder/distance_volume.h"

#include <memory>
#include <utility>
#include <vector>

namespace anvil {

inline constexpr uint32_t deform_workgroup = 64; ///< local_size_x of shaders/deform.comp

class DeformPipeline {
  public:
    /// @throws DeviceError
    explicit DeformPipeline(std::shared_ptr<Device> device);

    DeviceState& device() const { return device_->state(); }
    const DeviceInfo& info() const { return device_->info(); }
    const ComputeKernel& kernel() const { return kernel_; }

    /// The field as a texture; uploaded once as long as both live. @throws DeviceError
    std::shared_ptr<const VolumeTexture> texture(const std::shared_ptr<const DistanceVolume>& volume);
    /// Bound where a kernel's field is not used.
    const VolumeTexture& no_volume() const { return no_volume_; }

  private:
    using CachedTexture = std::pair<std::weak_ptr<const DistanceVolume>, std::weak_ptr<const VolumeTexture>>;

    std::shared_ptr<Device> device_;
    ComputeKernel kernel_;
    VolumeTexture no_volume_;
    std::vector<CachedTexture> textures_;
};

} // namespace anvil

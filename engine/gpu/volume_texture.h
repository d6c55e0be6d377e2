// A 3D texture of four numbers a voxel, sampled with hardware filtering; internal to engine/gpu and
// app/viewer.
#pragma once

#include "engine/gpu/held_memory.h"

#include <array>
#include <cstdint>
#include <span>

namespace anvil {

/// Linear filtering, clamped to the edge voxels' centres. RGBA32F where the device filters it, else RGBA16F.
class VolumeTexture {
  public:
    /// `texels`: 4 * size[0] * size[1] * size[2] floats, x fastest; every size >= 1.
    /// @throws DeviceError if a side exceeds the device's limit or memory is out; InternalError on a wrong
    /// count.
    VolumeTexture(DeviceState& device, std::array<uint32_t, 3> size, std::span<const float> texels);

    vk::ImageView view() const { return *view_; }
    vk::Sampler sampler() const { return *sampler_; }
    bool half_floats() const { return half_; }

  private:
    void make_image(DeviceState& device);
    void upload(DeviceState& device, std::span<const float> texels);

    std::array<uint32_t, 3> size_;
    bool half_ = false;
    HeldMemory memory_; ///< outlives the image bound to it
    vk::raii::Image image_{nullptr};
    vk::raii::ImageView view_{nullptr};
    vk::raii::Sampler sampler_{nullptr};
};

/// Records a layout change that waits for all earlier work and holds back all later work on the image.
void change_layout(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageLayout from,
                   vk::ImageLayout to, vk::ImageAspectFlags aspect = vk::ImageAspectFlagBits::eColor);

} // namespace anvil

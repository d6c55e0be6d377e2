// Draws marks over a picture, by the depths that it was drawn with; see shaders/viewer/marks.frag.
#pragma once

#include "app/viewer/marks.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/graphics_pipeline.h"

#include <span>

namespace anvil {

class MarksPass {
  public:
    /// `target`: where marks are drawn to, colours as shown. @throws DeviceError
    MarksPass(DeviceState& device, vk::Format target);

    /// Within a rendering of `target`'s format without depth, of so many pixels. `depths`: of the picture, as
    /// large, in the layout that shaders read. What an earlier call recorded is done.
    void record(const vk::raii::CommandBuffer& commands, std::span<const shader::Mark> marks,
                vk::ImageView depths, vk::Extent2D size);

  private:
    DeviceState& device_;
    vk::raii::Sampler sampler_{nullptr};
    vk::raii::DescriptorSetLayout set_layout_{nullptr};
    vk::raii::PipelineLayout layout_{nullptr};
    vk::raii::Pipeline pipeline_{nullptr};
    Buffer marks_;
    bool warm_ =
        false; ///< drivers compile shaders only when they are used first: that is not to be in a drag
};

} // namespace anvil

// Draws Dear ImGui's panels over a picture.
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/graphics_pipeline.h"

struct ImDrawData;

namespace anvil {

class UiPass {
  public:
    /// Takes the current ImGui context's fonts; `target`: where panels are drawn to, colours as shown.
    /// @throws DeviceError
    UiPass(DeviceState& device, vk::Format target);

    /// Within a rendering of `target`'s format without depth. What an earlier call recorded is done.
    void record(const vk::raii::CommandBuffer& commands, const ImDrawData& panels);

  private:
    void upload_fonts();
    void make_pipeline(vk::Format target);
    void upload(const ImDrawData& panels);
    void set_state(const vk::raii::CommandBuffer& commands, const ImDrawData& panels) const;

    DeviceState& device_;
    vk::raii::DeviceMemory font_memory_{nullptr}; ///< outlives the image bound to it
    vk::raii::Image font_{nullptr};
    vk::raii::ImageView font_view_{nullptr};
    vk::raii::Sampler sampler_{nullptr};
    vk::raii::DescriptorSetLayout set_layout_{nullptr};
    vk::raii::PipelineLayout layout_{nullptr};
    vk::raii::Pipeline pipeline_{nullptr};
    Buffer vertices_;
    Buffer indices_;
};

} // namespace anvil

#include "app/viewer/marks_pass.h"

#include "embedded/marks.frag.h"
#include "embedded/marks.vert.h"

#include <algorithm>
#include <array>
#include <utility>

namespace anvil {

namespace {

constexpr uint32_t corners = 6; ///< of a mark's two triangles
static_assert(sizeof(shader::Mark) == 64);

constexpr std::array<vk::DescriptorSetLayoutBinding, 2> bindings{
    {{.binding = 0,
      .descriptorType = vk::DescriptorType::eStorageBuffer,
      .descriptorCount = 1,
      .stageFlags = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment},
     {.binding = 1,
      .descriptorType = vk::DescriptorType::eCombinedImageSampler,
      .descriptorCount = 1,
      .stageFlags = vk::ShaderStageFlagBits::eFragment}}};

} // namespace

MarksPass::MarksPass(DeviceState& device, vk::Format target) : device_(device) {
    guarded("preparing to draw marks", [&] {
        sampler_ = device.device.createSampler({});
        set_layout_ = device.device.createDescriptorSetLayout(
            {.flags = vk::DescriptorSetLayoutCreateFlagBits::ePushDescriptorKHR,
             .bindingCount = bindings.size(),
             .pBindings = bindings.data()});
        const vk::PushConstantRange range{.stageFlags = vk::ShaderStageFlagBits::eVertex,
                                          .size = sizeof(glm::vec2)};
        layout_ = device.device.createPipelineLayout({.setLayoutCount = 1,
                                                      .pSetLayouts = &*set_layout_,
                                                      .pushConstantRangeCount = 1,
                                                      .pPushConstantRanges = &range});
        pipeline_ = make_graphics_pipeline(
            device, {target, vk::Format::eUndefined, vk::SampleCountFlagBits::e1}, *layout_,
            {.vertex = marks_vert, .fragment = marks_frag, .blending = Blending::over});
    });
}

void MarksPass::record(const vk::raii::CommandBuffer& commands, std::span<const shader::Mark> marks,
                       vk::ImageView depths, vk::Extent2D size) {
    constexpr std::array<shader::Mark, 1> unseen{};
    if (marks.empty() && std::exchange(warm_, true)) {
        return;
    }
    marks = marks.empty() ? unseen : marks;
    if (marks_.size() < marks.size_bytes()) {
        marks_ = Buffer(device_, std::max<uint64_t>(2 * marks.size_bytes(), 1U << 14),
                        vk::BufferUsageFlagBits::eStorageBuffer, MemoryUse::upload);
    }
    marks_.write(0, std::as_bytes(marks));
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_);
    const vk::DescriptorBufferInfo buffer{marks_.handle(), 0, VK_WHOLE_SIZE};
    const vk::DescriptorImageInfo picture{*sampler_, depths, vk::ImageLayout::eShaderReadOnlyOptimal};
    commands.pushDescriptorSetKHR(
        vk::PipelineBindPoint::eGraphics, *layout_, 0,
        std::array{vk::WriteDescriptorSet{.dstBinding = 0,
                                          .descriptorCount = 1,
                                          .descriptorType = bindings[0].descriptorType,
                                          .pBufferInfo = &buffer},
                   vk::WriteDescriptorSet{.dstBinding = 1,
                                          .descriptorCount = 1,
                                          .descriptorType = bindings[1].descriptorType,
                                          .pImageInfo = &picture}});
    const auto width = static_cast<float>(size.width);
    const auto height = static_cast<float>(size.height);
    commands.pushConstants<glm::vec2>(*layout_, vk::ShaderStageFlagBits::eVertex, 0,
                                      glm::vec2(width, height));
    commands.setViewport(0, vk::Viewport{0, 0, width, height, 0, 1});
    commands.setScissor(0, vk::Rect2D{{0, 0}, size});
    commands.draw(corners * static_cast<uint32_t>(marks.size()), 1, 0, 0);
}

} // namespace anvil

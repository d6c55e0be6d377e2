#include "app/viewer/ui_pass.h"

#include "engine/gpu/volume_texture.h"

#include "embedded/ui.frag.h"
#include "embedded/ui.vert.h"

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <imgui.h>

namespace anvil {

namespace {

constexpr std::array<vk::VertexInputAttributeDescription, 3> attributes{{
    {0, 0, vk::Format::eR32G32Sfloat, offsetof(ImDrawVert, pos)},
    {1, 0, vk::Format::eR32G32Sfloat, offsetof(ImDrawVert, uv)},
    {2, 0, vk::Format::eR8G8B8A8Unorm, offsetof(ImDrawVert, col)},
}};

constexpr vk::ImageSubresourceRange one_image{
    .aspectMask = vk::ImageAspectFlagBits::eColor, .levelCount = 1, .layerCount = 1};

/// Pixels to clip space.
struct Placing {
    glm::vec2 scale;
    glm::vec2 shift;
};

/// Grows by doubling, so that panels that change their size seldom take new memory.
void make_room(DeviceState& device, Buffer& buffer, uint64_t bytes, vk::BufferUsageFlags usage) {
    if (buffer.size() < bytes) {
        buffer = Buffer(device, std::max<uint64_t>(2 * bytes, 1U << 16), usage, MemoryUse::upload);
    }
}

} // namespace

UiPass::UiPass(DeviceState& device, vk::Format target) : device_(device) {
    guarded("preparing the panels", [&] {
        upload_fonts();
        make_pipeline(target);
    });
}

void UiPass::upload_fonts() {
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    const vk::Extent3D extent{static_cast<uint32_t>(width), static_cast<uint32_t>(height), 1};
    font_ = device_.device.createImage(
        {.imageType = vk::ImageType::e2D,
         .format = vk::Format::eR8Unorm,
         .extent = extent,
         .mipLevels = 1,
         .arrayLayers = 1,
         .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst});
    const vk::MemoryRequirements needs = font_.getMemoryRequirements();
    font_memory_ = device_.device.allocateMemory(
        {.allocationSize = needs.size,
         .memoryTypeIndex =
             device_.memory_type(needs.memoryTypeBits, {}, vk::MemoryPropertyFlagBits::eDeviceLocal)});
    font_.bindMemory(*font_memory_, 0);
    font_view_ = device_.device.createImageView({.image = *font_,
                                                 .viewType = vk::ImageViewType::e2D,
                                                 .format = vk::Format::eR8Unorm,
                                                 .subresourceRange = one_image});
    const std::span texels(pixels, static_cast<size_t>(width) * static_cast<size_t>(height));
    Buffer staging(device_, texels.size(), vk::BufferUsageFlagBits::eTransferSrc, MemoryUse::upload);
    staging.write_all(std::span<const unsigned char>(texels));
    run_commands(device_, [&](const vk::raii::CommandBuffer& commands) {
        change_layout(commands, *font_, vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
        commands.copyBufferToImage(
            staging.handle(), *font_, vk::ImageLayout::eTransferDstOptimal,
            vk::BufferImageCopy{
                .imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1},
                .imageExtent = extent});
        change_layout(commands, *font_, vk::ImageLayout::eTransferDstOptimal,
                      vk::ImageLayout::eShaderReadOnlyOptimal);
    });
    sampler_ = device_.device.createSampler({.magFilter = vk::Filter::eLinear,
                                             .minFilter = vk::Filter::eLinear,
                                             .addressModeU = vk::SamplerAddressMode::eClampToEdge,
                                             .addressModeV = vk::SamplerAddressMode::eClampToEdge});
}

void UiPass::make_pipeline(vk::Format target) {
    const vk::DescriptorSetLayoutBinding binding{.binding = 0,
                                                 .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                 .descriptorCount = 1,
                                                 .stageFlags = vk::ShaderStageFlagBits::eFragment};
    set_layout_ = device_.device.createDescriptorSetLayout(
        {.flags = vk::DescriptorSetLayoutCreateFlagBits::ePushDescriptorKHR,
         .bindingCount = 1,
         .pBindings = &binding});
    const vk::PushConstantRange range{.stageFlags = vk::ShaderStageFlagBits::eVertex,
                                      .size = sizeof(Placing)};
    layout_ = device_.device.createPipelineLayout({.setLayoutCount = 1,
                                                   .pSetLayouts = &*set_layout_,
                                                   .pushConstantRangeCount = 1,
                                                   .pPushConstantRanges = &range});
    pipeline_ = make_graphics_pipeline(device_, {target, vk::Format::eUndefined, vk::SampleCountFlagBits::e1},
                                       *layout_,
                                       {.vertex = ui_vert,
                                        .fragment = ui_frag,
                                        .vertex_bytes = sizeof(ImDrawVert),
                                        .attributes = attributes,
                                        .blending = Blending::over});
}

void UiPass::upload(const ImDrawData& panels) {
    make_room(device_, vertices_, static_cast<uint64_t>(panels.TotalVtxCount) * sizeof(ImDrawVert),
              vk::BufferUsageFlagBits::eVertexBuffer);
    make_room(device_, indices_, static_cast<uint64_t>(panels.TotalIdxCount) * sizeof(ImDrawIdx),
              vk::BufferUsageFlagBits::eIndexBuffer);
    uint64_t vertex_place = 0;
    uint64_t index_place = 0;
    for (int i = 0; i < panels.CmdListsCount; ++i) {
        const ImDrawList& list = *panels.CmdLists[i];
        const auto vertices =
            std::as_bytes(std::span(list.VtxBuffer.Data, static_cast<size_t>(list.VtxBuffer.Size)));
        const auto indices =
            std::as_bytes(std::span(list.IdxBuffer.Data, static_cast<size_t>(list.IdxBuffer.Size)));
        vertices_.write(vertex_place, vertices);
        indices_.write(index_place, indices);
        vertex_place += vertices.size();
        index_place += indices.size();
    }
}

void UiPass::set_state(const vk::raii::CommandBuffer& commands, const ImDrawData& panels) const {
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_);
    const vk::DescriptorImageInfo font{*sampler_, *font_view_, vk::ImageLayout::eShaderReadOnlyOptimal};
    commands.pushDescriptorSetKHR(
        vk::PipelineBindPoint::eGraphics, *layout_, 0,
        vk::WriteDescriptorSet{.dstBinding = 0,
                               .descriptorCount = 1,
                               .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                               .pImageInfo = &font});
    const glm::vec2 scale(2 / panels.DisplaySize.x, 2 / panels.DisplaySize.y);
    const Placing placing{scale, glm::vec2(-1) - glm::vec2(panels.DisplayPos.x, panels.DisplayPos.y) * scale};
    commands.pushConstants<Placing>(*layout_, vk::ShaderStageFlagBits::eVertex, 0, placing);
    commands.setViewport(0, vk::Viewport{0, 0, panels.DisplaySize.x, panels.DisplaySize.y, 0, 1});
    commands.bindVertexBuffers(0, vertices_.handle(), vk::DeviceSize{0});
    commands.bindIndexBuffer(indices_.handle(), 0, vk::IndexType::eUint16);
}

void UiPass::record(const vk::raii::CommandBuffer& commands, const ImDrawData& panels) {
    static_assert(sizeof(ImDrawIdx) == 2);
    if (panels.TotalVtxCount == 0) {
        return;
    }
    upload(panels);
    set_state(commands, panels);
    uint32_t first_index = 0;
    int32_t first_vertex = 0;
    for (int i = 0; i < panels.CmdListsCount; ++i) {
        const ImDrawList& list = *panels.CmdLists[i];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const glm::vec2 low = glm::max(glm::vec2(command.ClipRect.x, command.ClipRect.y), glm::vec2(0));
            const glm::vec2 high = glm::min(glm::vec2(command.ClipRect.z, command.ClipRect.w),
                                            glm::vec2(panels.DisplaySize.x, panels.DisplaySize.y));
            if (high.x <= low.x || high.y <= low.y) {
                continue;
            }
            commands.setScissor(0, vk::Rect2D{{static_cast<int32_t>(low.x), static_cast<int32_t>(low.y)},
                                              {static_cast<uint32_t>(high.x - low.x),
                                               static_cast<uint32_t>(high.y - low.y)}});
            commands.drawIndexed(command.ElemCount, 1, first_index + command.IdxOffset,
                                 first_vertex + static_cast<int32_t>(command.VtxOffset), 0);
        }
        first_index += static_cast<uint32_t>(list.IdxBuffer.Size);
        first_vertex += list.VtxBuffer.Size;
    }
}

} // namespace anvil

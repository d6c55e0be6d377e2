#include "engine/gpu/render_target.h"

#include "engine/gpu/volume_texture.h"

namespace anvil {

namespace {

Attachment make_attachment(DeviceState& device, vk::Extent3D extent, vk::Format format,
                           vk::SampleCountFlagBits samples, vk::ImageUsageFlags usage,
                           vk::ImageAspectFlags aspect) {
    Attachment result;
    result.image = device.device.createImage({.imageType = vk::ImageType::e2D,
                                              .format = format,
                                              .extent = extent,
                                              .mipLevels = 1,
                                              .arrayLayers = 1,
                                              .samples = samples,
                                              .usage = usage});
    const vk::MemoryRequirements needs = result.image.getMemoryRequirements();
    result.memory = device.device.allocateMemory(
        {.allocationSize = needs.size,
         .memoryTypeIndex =
             device.memory_type(needs.memoryTypeBits, {}, vk::MemoryPropertyFlagBits::eDeviceLocal)});
    result.image.bindMemory(*result.memory, 0);
    result.view = device.device.createImageView(
        {.image = *result.image,
         .viewType = vk::ImageViewType::e2D,
         .format = format,
         .subresourceRange = {.aspectMask = aspect, .levelCount = 1, .layerCount = 1}});
    return result;
}

} // namespace

vk::Format RenderTarget::depth_format(const DeviceState& device) {
    const auto features = device.physical.getFormatProperties(vk::Format::eD32Sfloat).optimalTilingFeatures;
    return features & vk::FormatFeatureFlagBits::eDepthStencilAttachment ? vk::Format::eD32Sfloat
                                                                         : vk::Format::eX8D24UnormPack32;
}

vk::SampleCountFlagBits RenderTarget::sample_count(const DeviceState& device) {
    const auto counts =
        device.limits.framebufferColorSampleCounts & device.limits.framebufferDepthSampleCounts;
    return counts & vk::SampleCountFlagBits::e4 ? vk::SampleCountFlagBits::e4 : vk::SampleCountFlagBits::e1;
}

RenderTarget::RenderTarget(DeviceState& device, uint32_t width, uint32_t height,
                           vk::SampleCountFlagBits samples, vk::Format format, bool keeps_depth)
    : width_(width), height_(height), multisampled_(samples != vk::SampleCountFlagBits::e1),
      keeps_depth_(keeps_depth) {
    const uint32_t limit = std::min({device.limits.maxImageDimension2D, device.limits.maxFramebufferWidth,
                                     device.limits.maxFramebufferHeight});
    if (width > limit || height > limit) {
        throw DeviceError("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                          " is wanted, device \"" + device.info.name + "\" draws at most " +
                          std::to_string(limit) + " a side; use a smaller --size");
    }
    guarded("taking memory for a picture", [&] {
        const vk::Extent3D extent{width, height, 1};
        const auto colour = vk::ImageUsageFlagBits::eColorAttachment;
        const auto copied = vk::ImageUsageFlagBits::eTransferSrc | vk::ImageUsageFlagBits::eTransferDst;
        const auto read = colour | copied;
        colour_ = make_attachment(device, extent, format, samples, multisampled_ ? colour : read,
                                  vk::ImageAspectFlagBits::eColor);
        if (multisampled_) {
            resolved_ = make_attachment(device, extent, format, vk::SampleCountFlagBits::e1, read,
                                        vk::ImageAspectFlagBits::eColor);
        }
        const auto depth = vk::ImageUsageFlagBits::eDepthStencilAttachment;
        const auto kept = keeps_depth ? depth | copied | vk::ImageUsageFlagBits::eSampled : depth;
        depth_ = make_attachment(device, extent, depth_format(device), samples, multisampled_ ? depth : kept,
                                 vk::ImageAspectFlagBits::eDepth);
        if (multisampled_ && keeps_depth) {
            resolved_depth_ =
                make_attachment(device, extent, depth_format(device), vk::SampleCountFlagBits::e1, kept,
                                vk::ImageAspectFlagBits::eDepth);
        }
    });
}

void RenderTarget::begin(const vk::raii::CommandBuffer& commands, Part part) const {
    const auto undefined = vk::ImageLayout::eUndefined;
    const auto drawn = vk::ImageLayout::eColorAttachmentOptimal;
    const auto tested = vk::ImageLayout::eDepthAttachmentOptimal;
    const auto left_in = [&](vk::ImageLayout layout) { return part.first ? undefined : layout; };
    const bool resolves = multisampled_ && part.last;
    change_layout(commands, *colour_.image, left_in(drawn), drawn);
    if (resolves) {
        change_layout(commands, *resolved_.image, undefined, drawn);
    }
    change_layout(commands, *depth_.image, left_in(tested), tested, vk::ImageAspectFlagBits::eDepth);
    const auto load = part.first ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eLoad;
    const auto keep = part.last ? vk::AttachmentStoreOp::eDontCare : vk::AttachmentStoreOp::eStore;
    vk::RenderingAttachmentInfo colour{.imageView = *colour_.view,
                                       .imageLayout = drawn,
                                       .loadOp = load,
                                       .storeOp = vk::AttachmentStoreOp::eStore};
    if (resolves) {
        colour.resolveMode = vk::ResolveModeFlagBits::eAverage;
        colour.resolveImageView = *resolved_.view;
        colour.resolveImageLayout = drawn;
        colour.storeOp = keep;
    }
    vk::RenderingAttachmentInfo depth{
        .imageView = *depth_.view,
        .imageLayout = tested,
        .loadOp = load,
        .storeOp = keeps_depth_ && !multisampled_ ? vk::AttachmentStoreOp::eStore : keep,
        .clearValue = vk::ClearDepthStencilValue{1.0F, 0}};
    if (resolves && keeps_depth_) {
        change_layout(commands, *resolved_depth_.image, undefined, tested, vk::ImageAspectFlagBits::eDepth);
        depth.resolveMode = vk::ResolveModeFlagBits::eSampleZero; // which every device has
        depth.resolveImageView = *resolved_depth_.view;
        depth.resolveImageLayout = tested;
    }
    const vk::Rect2D area{{0, 0}, {width_, height_}};
    commands.beginRendering({.renderArea = area,
                             .layerCount = 1,
                             .colorAttachmentCount = 1,
                             .pColorAttachments = &colour,
                             .pDepthAttachment = &depth});
    commands.setViewport(
        0, vk::Viewport{0, 0, static_cast<float>(width_), static_cast<float>(height_), 0.0F, 1.0F});
    commands.setScissor(0, area);
}

void RenderTarget::end(const vk::raii::CommandBuffer& commands, bool last) const {
    commands.endRendering();
    if (!last) {
        return;
    }
    change_layout(commands, colour(), vk::ImageLayout::eColorAttachmentOptimal,
                  vk::ImageLayout::eTransferSrcOptimal);
    if (keeps_depth_) {
        change_layout(commands, *(multisampled_ ? resolved_depth_ : depth_).image,
                      vk::ImageLayout::eDepthAttachmentOptimal, vk::ImageLayout::eShaderReadOnlyOptimal,
                      vk::ImageAspectFlagBits::eDepth);
    }
}

void RenderTarget::copy_from(const vk::raii::CommandBuffer& commands, const RenderTarget& other) const {
    const auto copy = [&](const Attachment& from, const Attachment& to, vk::ImageLayout from_left_in,
                          vk::ImageLayout begins_in, vk::ImageAspectFlags aspect) {
        const auto source = vk::ImageLayout::eTransferSrcOptimal;
        const auto target = vk::ImageLayout::eTransferDstOptimal;
        change_layout(commands, *from.image, from_left_in, source, aspect);
        change_layout(commands, *to.image, vk::ImageLayout::eUndefined, target, aspect);
        const vk::ImageSubresourceLayers layer{.aspectMask = aspect, .layerCount = 1};
        commands.copyImage(
            *from.image, source, *to.image, target,
            vk::ImageCopy{.srcSubresource = layer, .dstSubresource = layer, .extent = {width_, height_, 1}});
        change_layout(commands, *from.image, source, from_left_in, aspect);
        change_layout(commands, *to.image, target, begins_in, aspect);
    };
    copy(other.colour_, colour_, vk::ImageLayout::eTransferSrcOptimal,
         vk::ImageLayout::eColorAttachmentOptimal, vk::ImageAspectFlagBits::eColor);
    copy(other.depth_, depth_, vk::ImageLayout::eShaderReadOnlyOptimal,
         vk::ImageLayout::eDepthAttachmentOptimal, vk::ImageAspectFlagBits::eDepth);
}

} // namespace anvil

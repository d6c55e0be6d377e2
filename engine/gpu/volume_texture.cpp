#include "engine/gpu/volume_texture.h"

#include "engine/gpu/buffer.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>

namespace anvil {

namespace {

constexpr uint64_t staging_bytes = 16U << 20;

bool filters_linearly(const DeviceState& device, vk::Format format) {
    const auto features = device.physical.getFormatProperties(format).optimalTilingFeatures;
    const auto wanted =
        vk::FormatFeatureFlagBits::eSampledImage | vk::FormatFeatureFlagBits::eSampledImageFilterLinear;
    return (features & wanted) == wanted;
}

std::vector<std::byte> as_half(std::span<const float> values) {
    std::vector<std::byte> bytes(values.size() * 2);
    auto* out = reinterpret_cast<uint16_t*>(bytes.data());
    std::transform(values.begin(), values.end(), out, [](float v) { return glm::packHalf1x16(v); });
    return bytes;
}

} // namespace

void change_layout(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageLayout from,
                   vk::ImageLayout to, vk::ImageAspectFlags aspect) {
    const vk::ImageMemoryBarrier2 barrier{
        .srcStageMask = vk::PipelineStageFlagBits2::eAllCommands,
        .srcAccessMask = vk::AccessFlagBits2::eMemoryWrite,
        .dstStageMask = vk::PipelineStageFlagBits2::eAllCommands,
        .dstAccessMask = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite,
        .oldLayout = from,
        .newLayout = to,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image,
        .subresourceRange = {.aspectMask = aspect, .levelCount = 1, .layerCount = 1}};
    commands.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier});
}

VolumeTexture::VolumeTexture(DeviceState& device, std::array<uint32_t, 3> size, std::span<const float> texels)
    : size_(size), half_(!filters_linearly(device, vk::Format::eR32G32B32A32Sfloat)) {
    const uint64_t count = uint64_t{size[0]} * size[1] * size[2];
    if (count == 0 || texels.size() != 4 * count) {
        throw InternalError("a volume texture got a wrong number of texels");
    }
    if (*std::max_element(size.begin(), size.end()) > device.limits.maxImageDimension3D) {
        throw DeviceError("a distance field of " + std::to_string(size[0]) + " x " + std::to_string(size[1]) +
                          " x " + std::to_string(size[2]) + " voxels is wanted, device \"" +
                          device.info.name + "\" takes at most " +
                          std::to_string(device.limits.maxImageDimension3D) + " a side");
    }
    guarded("taking memory for a distance field", [&] {
        make_image(device);
        upload(device, texels);
    });
}

void VolumeTexture::make_image(DeviceState& device) {
    const vk::Format format = half_ ? vk::Format::eR16G16B16A16Sfloat : vk::Format::eR32G32B32A32Sfloat;
    image_ = device.device.createImage(
        {.imageType = vk::ImageType::e3D,
         .format = format,
         .extent = {size_[0], size_[1], size_[2]},
         .mipLevels = 1,
         .arrayLayers = 1,
         .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst});
    const vk::MemoryRequirements needs = image_.getMemoryRequirements();
    memory_ =
        HeldMemory(device, needs.size,
                   device.memory_type(needs.memoryTypeBits, {}, vk::MemoryPropertyFlagBits::eDeviceLocal));
    image_.bindMemory(*memory_.memory(), 0);
    view_ = device.device.createImageView({.image = *image_,
                                           .viewType = vk::ImageViewType::e3D,
                                           .format = format,
                                           .subresourceRange = {.aspectMask = vk::ImageAspectFlagBits::eColor,
                                                                .levelCount = 1,
                                                                .layerCount = 1}});
    sampler_ = device.device.createSampler({.magFilter = vk::Filter::eLinear,
                                            .minFilter = vk::Filter::eLinear,
                                            .addressModeU = vk::SamplerAddressMode::eClampToEdge,
                                            .addressModeV = vk::SamplerAddressMode::eClampToEdge,
                                            .addressModeW = vk::SamplerAddressMode::eClampToEdge});
}

void VolumeTexture::upload(DeviceState& device, std::span<const float> texels) {
    const uint64_t slice_values = uint64_t{4} * size_[0] * size_[1];
    const uint64_t value_bytes = half_ ? 2 : 4;
    const uint64_t most = std::max<uint64_t>(1, staging_bytes / (slice_values * value_bytes));
    const auto slices = static_cast<uint32_t>(std::min<uint64_t>(most, size_[2]));
    Buffer staging(device, slices * slice_values * value_bytes, {}, MemoryUse::upload);
    for (uint32_t z = 0; z < size_[2]; z += slices) {
        const uint32_t depth = std::min(slices, size_[2] - z);
        const std::span<const float> piece = texels.subspan(z * slice_values, depth * slice_values);
        half_ ? staging.write(0, as_half(piece)) : staging.write(0, std::as_bytes(piece));
        run_commands(device, [&](const vk::raii::CommandBuffer& commands) {
            if (z == 0) {
                change_layout(commands, *image_, vk::ImageLayout::eUndefined,
                              vk::ImageLayout::eTransferDstOptimal);
            }
            const vk::BufferImageCopy region{
                .imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1},
                .imageOffset = {0, 0, static_cast<int32_t>(z)},
                .imageExtent = {size_[0], size_[1], depth}};
            full_barrier(commands);
            commands.copyBufferToImage(staging.handle(), *image_, vk::ImageLayout::eTransferDstOptimal,
                                       region);
            if (z + depth == size_[2]) {
                change_layout(commands, *image_, vk::ImageLayout::eTransferDstOptimal,
                              vk::ImageLayout::eShaderReadOnlyOptimal);
            }
        });
    }
}

} // namespace anvil

#include "app/viewer/painter.h"

#include "engine/gpu/volume_texture.h"

#include <imgui.h>

namespace anvil {

namespace {

/// Drawn in linear light; the window's image takes the same bytes as they are.
vk::Format scene_format(vk::Format window) {
    return window == vk::Format::eB8G8R8A8Unorm ? vk::Format::eB8G8R8A8Srgb : vk::Format::eR8G8B8A8Srgb;
}

vk::SemaphoreSubmitInfo at_all_stages(vk::Semaphore semaphore) {
    return {.semaphore = semaphore, .stageMask = vk::PipelineStageFlagBits2::eAllCommands};
}

} // namespace

Painter::Painter(Device& device, const Window& window)
    : device_(device.state()), swapchain_(device_, window), ui_(device_, swapchain_.format()),
      commands_(device_) {}

Painter::~Painter() {
    try {
        commands_.wait();
    } catch (const DeviceError&) {
        return; // a lost device has nothing left to wait for
    }
}

bool Painter::draws_on_cpu() const {
    return device_.info.type == DeviceType::cpu;
}

Painter::Canvas& Painter::canvas(bool fine) {
    const vk::SampleCountFlagBits samples =
        fine ? RenderTarget::sample_count(device_) : vk::SampleCountFlagBits::e1;
    std::optional<Canvas>& canvas = fine ? fine_ : plain_;
    if (!canvas) {
        const TargetFormat format{scene_format(swapchain_.format()), RenderTarget::depth_format(device_),
                                  samples};
        canvas.emplace(Canvas{format, ScenePass(device_, format), std::nullopt, {}, {}});
    }
    if (!canvas->target || canvas->size != swapchain_.size()) {
        canvas->shown.reset();
        canvas->size = swapchain_.size();
        canvas->target.emplace(device_, static_cast<uint32_t>(canvas->size.width),
                               static_cast<uint32_t>(canvas->size.height), samples, canvas->format.colour);
    }
    return *canvas;
}

bool Painter::paint(const Scene& scene, const ImDrawData& panels, bool fine) {
    commands_.wait(); // what the last frame read may change now
    const std::optional<WindowImage> image = swapchain_.acquire();
    if (!image) {
        return false;
    }
    Canvas& drawn_to = canvas(fine);
    // While only panels and marks change, the surface is not drawn again.
    const bool drawn = drawn_to.shown == scene;
    if (!drawn) {
        drawn_to.pass.prepare(scene);
        for (std::optional<Canvas>* other :
             {&plain_, &fine_}) { // one scene is kept from being freed, not two
            if (*other) {
                (*other)->shown.reset();
            }
        }
        drawn_to.shown = scene;
    }
    const vk::raii::CommandBuffer& commands = commands_.begin();
    guarded("drawing", [&] { record(commands, drawn_to, *image, drawn, panels); });
    commands_.submit(at_all_stages(swapchain_.acquired()), at_all_stages(swapchain_.drawn(*image)));
    swapchain_.show(*image);
    return true;
}

void Painter::record(const vk::raii::CommandBuffer& commands, Canvas& canvas, const WindowImage& image,
                     bool drawn, const ImDrawData& panels) {
    full_barrier(commands); // the places that a drag has submitted
    if (!drawn) {
        canvas.target->begin(commands);
        canvas.pass.record(commands, *canvas.shown);
        canvas.target->end(commands);
    }
    const vk::Extent2D extent{static_cast<uint32_t>(canvas.size.width),
                              static_cast<uint32_t>(canvas.size.height)};
    const vk::ImageSubresourceLayers layer{.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1};
    change_layout(commands, image.image, vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
    commands.copyImage(canvas.target->colour(), vk::ImageLayout::eTransferSrcOptimal, image.image,
                       vk::ImageLayout::eTransferDstOptimal,
                       vk::ImageCopy{.srcSubresource = layer,
                                     .dstSubresource = layer,
                                     .extent = {extent.width, extent.height, 1}});
    change_layout(commands, image.image, vk::ImageLayout::eTransferDstOptimal,
                  vk::ImageLayout::eColorAttachmentOptimal);
    const vk::RenderingAttachmentInfo colour{.imageView = image.view,
                                             .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                             .loadOp = vk::AttachmentLoadOp::eLoad,
                                             .storeOp = vk::AttachmentStoreOp::eStore};
    commands.beginRendering({.renderArea = {{0, 0}, extent},
                             .layerCount = 1,
                             .colorAttachmentCount = 1,
                             .pColorAttachments = &colour});
    ui_.record(commands, panels);
    commands.endRendering();
    keep_picture(commands, image);
}

void Painter::keep_picture(const vk::raii::CommandBuffer& commands, const WindowImage& image) {
    pixels_size_ = swapchain_.size();
    const uint64_t bytes =
        uint64_t{4} * static_cast<uint64_t>(pixels_size_.width) * static_cast<uint64_t>(pixels_size_.height);
    if (pixels_.size() != bytes) {
        pixels_ = Buffer(device_, bytes, {}, MemoryUse::download);
    }
    change_layout(commands, image.image, vk::ImageLayout::eColorAttachmentOptimal,
                  vk::ImageLayout::eTransferSrcOptimal);
    commands.copyImageToBuffer(
        image.image, vk::ImageLayout::eTransferSrcOptimal, pixels_.handle(),
        vk::BufferImageCopy{
            .imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1},
            .imageExtent = {static_cast<uint32_t>(pixels_size_.width),
                            static_cast<uint32_t>(pixels_size_.height), 1}});
    change_layout(commands, image.image, vk::ImageLayout::eTransferSrcOptimal,
                  vk::ImageLayout::ePresentSrcKHR);
}

Picture Painter::picture() {
    if (pixels_size_.empty()) {
        throw InternalError("a picture was asked for before the first frame");
    }
    commands_.wait();
    Picture picture{static_cast<uint32_t>(pixels_size_.width), static_cast<uint32_t>(pixels_size_.height),
                    std::vector<uint8_t>(pixels_.size())};
    pixels_.read(0, std::as_writable_bytes(std::span(picture.rgba)));
    const bool swapped = swapchain_.format() == vk::Format::eB8G8R8A8Unorm;
    for (size_t i = 0; i < picture.rgba.size(); i += 4) {
        if (swapped) {
            std::swap(picture.rgba[i], picture.rgba[i + 2]);
        }
        picture.rgba[i + 3] = 255;
    }
    return picture;
}

} // namespace anvil

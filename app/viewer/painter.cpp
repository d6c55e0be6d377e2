#include "app/viewer/painter.h"

#include "engine/gpu/volume_texture.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <imgui.h>

namespace anvil {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

constexpr vk::ImageSubresourceLayers one_layer{.aspectMask = vk::ImageAspectFlagBits::eColor,
                                               .layerCount = 1};

constexpr WindowSize warm_up_size{64, 64};

vk::Extent3D extent_of(WindowSize size) {
    return {static_cast<uint32_t>(size.width), static_cast<uint32_t>(size.height), 1};
}

vk::SemaphoreSubmitInfo at_all_stages(vk::Semaphore semaphore) {
    return {.semaphore = semaphore, .stageMask = vk::PipelineStageFlagBits2::eAllCommands};
}

} // namespace

Painter::Painter(Device& device, const Window& window, Disposer& disposer)
    : device_(device.state()), swapchain_(device_, window), marks_(device_, swapchain_.format()),
      ui_(device_, swapchain_.format()), picture_(device_, swapchain_.format(), draws_on_cpu(), disposer),
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

void Painter::wait() {
    const auto start = Clock::now();
    commands_.wait();
    picture_.took(handing_over_ + milliseconds_since(start));
}

void Painter::warm_up() {
    const Scene scene = scene_of_all_kinds(device_);
    for (const bool fine : {false, true}) {
        if (fine || draws_on_cpu()) { // others draw finely always
            picture_.prepare(scene, {warm_up_size, fine, true});
            const vk::raii::CommandBuffer& commands = commands_.begin();
            guarded("drawing", [&] { picture_.record(commands); });
            commands_.submit();
            commands_.wait();
        }
    }
}

Painted Painter::paint(const Scene& scene, const Cover& cover, const PaintWish& wish, FrameLog& log) {
    log.enter(FramePart::device);
    wait(); // what the last frame read may change now
    log.enter(FramePart::image);
    const std::optional<WindowImage> image = swapchain_.acquire();
    if (!image) {
        return Painted::nothing;
    }
    log.enter(FramePart::preparing);
    log.draws(picture_.prepare(scene, {swapchain_.size(), wish.fine, wish.kept, wish.steady}));
    log.enter(FramePart::recording);
    const vk::raii::CommandBuffer& commands = commands_.begin();
    guarded("drawing", [&] { record(commands, *image, cover, wish.kept); });
    log.enter(FramePart::submitting);
    const auto start = Clock::now();
    commands_.submit(at_all_stages(swapchain_.acquired()), at_all_stages(swapchain_.drawn(*image)));
    log.enter(FramePart::showing);
    swapchain_.show(*image); // some drivers wait here
    handing_over_ = milliseconds_since(start);
    return picture_.complete() ? Painted::all : Painted::in_part;
}

/// Where the window has become larger, what the picture does not cover is dark until there is a new one.
void Painter::copy_picture(const vk::raii::CommandBuffer& commands, const WindowImage& image) const {
    const WindowSize from = picture_.size();
    const WindowSize to = swapchain_.size();
    change_layout(commands, image.image, vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
    if (from != to) {
        commands.clearColorImage(image.image, vk::ImageLayout::eTransferDstOptimal,
                                 vk::ClearColorValue(std::array{0.1F, 0.1F, 0.1F, 1.0F}),
                                 vk::ImageSubresourceRange{.aspectMask = vk::ImageAspectFlagBits::eColor,
                                                           .levelCount = 1,
                                                           .layerCount = 1});
        full_barrier(commands);
    }
    const WindowSize both{std::min(from.width, to.width), std::min(from.height, to.height)};
    commands.copyImage(
        picture_.image(), vk::ImageLayout::eTransferSrcOptimal, image.image,
        vk::ImageLayout::eTransferDstOptimal,
        vk::ImageCopy{.srcSubresource = one_layer, .dstSubresource = one_layer, .extent = extent_of(both)});
    change_layout(commands, image.image, vk::ImageLayout::eTransferDstOptimal,
                  vk::ImageLayout::eColorAttachmentOptimal);
}

void Painter::record(const vk::raii::CommandBuffer& commands, const WindowImage& image, const Cover& cover,
                     bool kept) {
    full_barrier(commands); // the places that a drag has submitted
    picture_.record(commands);
    copy_picture(commands, image);
    const vk::RenderingAttachmentInfo colour{.imageView = image.view,
                                             .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                             .loadOp = vk::AttachmentLoadOp::eLoad,
                                             .storeOp = vk::AttachmentStoreOp::eStore};
    const vk::Extent3D extent = extent_of(swapchain_.size());
    commands.beginRendering({.renderArea = {{0, 0}, {extent.width, extent.height}},
                             .layerCount = 1,
                             .colorAttachmentCount = 1,
                             .pColorAttachments = &colour});
    marks_.record(commands, cover.marks, picture_.depths(), {extent.width, extent.height});
    ui_.record(commands, cover.panels);
    commands.endRendering();
    if (kept) {
        keep_picture(commands, image);
    }
    change_layout(commands, image.image,
                  kept ? vk::ImageLayout::eTransferSrcOptimal : vk::ImageLayout::eColorAttachmentOptimal,
                  vk::ImageLayout::ePresentSrcKHR);
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
        vk::BufferImageCopy{.imageSubresource = one_layer, .imageExtent = extent_of(pixels_size_)});
}

Picture Painter::picture() {
    if (pixels_size_.empty()) {
        throw InternalError("a picture was asked for before the first frame");
    }
    wait();
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

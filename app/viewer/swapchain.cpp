#include "app/viewer/swapchain.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace anvil {

namespace {

constexpr uint64_t patience = 2'000'000'000; // nanoseconds; a hidden window may give no image at all

vk::PresentModeKHR present_mode(const std::vector<vk::PresentModeKHR>& modes) {
    // Newest picture first: a drag that outruns the display must not queue up behind it.
    const bool newest = std::find(modes.begin(), modes.end(), vk::PresentModeKHR::eMailbox) != modes.end();
    return newest ? vk::PresentModeKHR::eMailbox : vk::PresentModeKHR::eFifo;
}

} // namespace

Swapchain::Swapchain(DeviceState& device, const Window& window) : device_(device), window_(window) {
    guarded("preparing the window", [&] {
        make_surface();
        acquired_ = device.device.createSemaphore({});
    });
}

Swapchain::~Swapchain() {
    try {
        device_.device.waitIdle(); // what is being shown reads the images
    } catch (const vk::SystemError&) {
        return; // a lost device has nothing left to wait for
    }
}

void Swapchain::make_surface() {
    chain_.clear();
    surface_.clear();
    surface_ = vk::raii::SurfaceKHR(device_.instance, window_.make_surface(*device_.instance));
    if (device_.physical.getSurfaceSupportKHR(device_.queue_family, *surface_) != VK_TRUE) {
        throw DeviceError("device \"" + device_.info.name +
                          "\" cannot show pictures in this window; choose another with `--device`");
    }
    choose_format();
    outdated_ = true;
}

void Swapchain::choose_format() {
    format_ = vk::Format::eUndefined;
    for (const vk::SurfaceFormatKHR& offered : device_.physical.getSurfaceFormatsKHR(*surface_)) {
        const bool known =
            offered.format == vk::Format::eB8G8R8A8Unorm || offered.format == vk::Format::eR8G8B8A8Unorm;
        if (known && offered.colorSpace == vk::ColorSpaceKHR::eSrgbNonlinear &&
            format_ == vk::Format::eUndefined) {
            format_ = offered.format;
        }
    }
    if (format_ == vk::Format::eUndefined) {
        throw DeviceError("device \"" + device_.info.name + "\" shows no images of eight bits a colour");
    }
}

void Swapchain::make_images() {
    const vk::SurfaceCapabilitiesKHR can = device_.physical.getSurfaceCapabilitiesKHR(*surface_);
    const WindowSize wanted = window_.framebuffer_size();
    vk::Extent2D extent = can.currentExtent;
    if (extent.width == std::numeric_limits<uint32_t>::max()) {
        extent.width = std::clamp(static_cast<uint32_t>(wanted.width), can.minImageExtent.width,
                                  can.maxImageExtent.width);
        extent.height = std::clamp(static_cast<uint32_t>(wanted.height), can.minImageExtent.height,
                                   can.maxImageExtent.height);
    }
    size_ = {static_cast<int>(extent.width), static_cast<int>(extent.height)};
    if (size_.empty()) {
        return;
    }
    device_.device.waitIdle();
    const uint32_t count =
        std::min(can.minImageCount + 1, can.maxImageCount > 0 ? can.maxImageCount : can.minImageCount + 1);
    const vk::raii::SwapchainKHR old = std::move(chain_);
    chain_ = device_.device.createSwapchainKHR(
        {.surface = *surface_,
         .minImageCount = count,
         .imageFormat = format_,
         .imageColorSpace = vk::ColorSpaceKHR::eSrgbNonlinear,
         .imageExtent = extent,
         .imageArrayLayers = 1,
         .imageUsage = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferDst |
                       vk::ImageUsageFlagBits::eTransferSrc,
         .preTransform = can.currentTransform,
         .compositeAlpha = vk::CompositeAlphaFlagBitsKHR::eOpaque,
         .presentMode = present_mode(device_.physical.getSurfacePresentModesKHR(*surface_)),
         .clipped = VK_TRUE,
         .oldSwapchain = *old});
    views_.clear();
    drawn_.clear();
    images_.clear();
    for (const auto image : chain_.getImages()) {
        images_.emplace_back(image);
        views_.push_back(device_.device.createImageView(
            {.image = images_.back(),
             .viewType = vk::ImageViewType::e2D,
             .format = format_,
             .subresourceRange = {
                 .aspectMask = vk::ImageAspectFlagBits::eColor, .levelCount = 1, .layerCount = 1}}));
        drawn_.push_back(device_.device.createSemaphore({}));
    }
    outdated_ = false;
}

std::optional<WindowImage> Swapchain::acquire() {
    return guarded("taking an image of the window", [&]() -> std::optional<WindowImage> {
        for (int attempt = 0; attempt < 3; ++attempt) {
            const WindowSize wanted = window_.framebuffer_size();
            if (wanted.empty()) {
                return std::nullopt;
            }
            try {
                if (std::exchange(lost_, false)) {
                    throw vk::SurfaceLostKHRError("the window's surface");
                }
                if (outdated_ || wanted != size_) {
                    make_images();
                    if (outdated_) {
                        return std::nullopt;
                    }
                }
                const auto [result, index] = chain_.acquireNextImage(patience, *acquired_);
                if (result == vk::Result::eSuccess || result == vk::Result::eSuboptimalKHR) {
                    outdated_ = result == vk::Result::eSuboptimalKHR;
                    return WindowImage{images_[index], *views_[index], index};
                }
                return std::nullopt; // no image within our patience
            } catch (const vk::OutOfDateKHRError&) {
                outdated_ = true;
            } catch (const vk::SurfaceLostKHRError&) {
                device_.device.waitIdle();
                make_surface();
            }
        }
        return std::nullopt;
    });
}

void Swapchain::show(const WindowImage& image) {
    guarded("showing a picture", [&] {
        const vk::Semaphore wait = *drawn_[image.index];
        const vk::SwapchainKHR chain = *chain_;
        const std::lock_guard lock(device_.queue_mutex);
        try {
            const vk::Result result = device_.queue.presentKHR({.waitSemaphoreCount = 1,
                                                                .pWaitSemaphores = &wait,
                                                                .swapchainCount = 1,
                                                                .pSwapchains = &chain,
                                                                .pImageIndices = &image.index});
            outdated_ = outdated_ || result == vk::Result::eSuboptimalKHR;
        } catch (const vk::OutOfDateKHRError&) {
            outdated_ = true;
        } catch (const vk::SurfaceLostKHRError&) {
            lost_ = true; // the next acquire() makes a new one
        }
    });
}

} // namespace anvil

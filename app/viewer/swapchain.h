// The window's images: taken, drawn to, shown.
#pragma once

#include "app/viewer/window.h"
#include "engine/gpu/device_state.h"

#include <memory>
#include <optional>

namespace anvil {

/// One of the window's images, to be drawn to as colours that are sRGB already (no conversion on writing).
struct WindowImage {
    vk::Image image;
    vk::ImageView view;
    uint32_t index = 0;
};

class Swapchain {
  public:
    /// @throws DeviceError if the device cannot show pictures in the window.
    Swapchain(DeviceState& device, const Window& window);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// The next image, once it is free; nothing while the window has no size. A window of another size, or
    /// one whose surface was lost, gets new images first. @throws DeviceError
    std::optional<WindowImage> acquire();
    /// What drawing waits for, and what it signals before show().
    vk::Semaphore acquired() const { return *acquired_; }
    vk::Semaphore drawn(const WindowImage& image) const { return *drawn_[image.index]; }
    void show(const WindowImage& image);

    /// The next acquire() finds the surface lost.
    void lose_surface() { lost_ = true; }

    vk::Format format() const { return format_; }
    WindowSize size() const { return size_; }

  private:
    void make_surface();
    void make_images();
    void choose_format();

    DeviceState& device_;
    const Window& window_;
    vk::raii::SurfaceKHR surface_{nullptr};
    vk::raii::SwapchainKHR chain_{nullptr};
    std::vector<vk::Image> images_;
    std::vector<vk::raii::ImageView> views_;
    std::vector<vk::raii::Semaphore> drawn_; ///< one an image: shown images keep theirs busy
    vk::raii::Semaphore acquired_{nullptr};
    vk::Format format_ = vk::Format::eUndefined;
    WindowSize size_;
    bool outdated_ = true;
    bool lost_ = false; ///< the surface
};

} // namespace anvil

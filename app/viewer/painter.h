// Frames: a scene and panels over it, shown in the window.
#pragma once

#include "app/viewer/scene_pass.h"
#include "app/viewer/swapchain.h"
#include "app/viewer/ui_pass.h"
#include "engine/gpu/device.h"
#include "engine/gpu/picture.h"
#include "engine/gpu/render_target.h"

#include <optional>

namespace anvil {

class Painter {
  public:
    /// Takes the current ImGui context's fonts. @throws DeviceError
    Painter(Device& device, const Window& window);
    ~Painter();

    /// Draws and shows; waits for the frame before. `fine`: several samples a pixel. False where the window
    /// has nothing to show it in. @throws DeviceError
    bool paint(const Scene& scene, const ImDrawData& panels, bool fine);

    /// The last frame. @throws DeviceError; InternalError before the first
    Picture picture();

    /// Several samples a pixel cost as much as so many windows where the CPU draws.
    bool draws_on_cpu() const;

  private:
    /// Where a scene is drawn to, and how.
    struct Canvas {
        TargetFormat format;
        ScenePass pass;
        std::optional<RenderTarget> target;
        WindowSize size;
        std::optional<Scene> shown; ///< what the target holds; nothing: it is to be drawn
    };

    Canvas& canvas(bool fine);
    /// `drawn`: the target holds the scene already.
    void record(const vk::raii::CommandBuffer& commands, Canvas& canvas, const WindowImage& image, bool drawn,
                const ImDrawData& panels);
    void keep_picture(const vk::raii::CommandBuffer& commands, const WindowImage& image);

    DeviceState& device_;
    Swapchain swapchain_;
    UiPass ui_;
    std::optional<Canvas> plain_;
    std::optional<Canvas> fine_;
    Buffer pixels_; ///< the last frame
    WindowSize pixels_size_;
    Commands commands_;
};

} // namespace anvil

// Frames: a scene and panels over it, shown in the window.
#pragma once

#include "app/viewer/frame_log.h"
#include "app/viewer/marks_pass.h"
#include "app/viewer/scene_picture.h"
#include "app/viewer/swapchain.h"
#include "app/viewer/ui_pass.h"
#include "engine/gpu/device.h"
#include "engine/gpu/picture.h"

#include <optional>

namespace anvil {

enum class Painted : uint8_t {
    nothing, ///< the window has nothing to show it in
    in_part, ///< the scene is not all there: paint again
    all
};

struct PaintWish {
    bool fine = false;   ///< several samples a pixel
    bool kept = false;   ///< all of the scene, however long it takes, and for picture()
    bool steady = false; ///< as PictureWish::steady
};

class Painter {
  public:
    /// Takes the current ImGui context's fonts; `disposer` gets the scenes that are no longer shown.
    /// @throws DeviceError
    Painter(Device& device, const Window& window, Disposer& disposer);
    ~Painter();

    /// Draws one of each kind of thing where nobody sees it: drivers compile shaders only when they are used
    /// first, which takes a CPU a second. @throws DeviceError
    void warm_up();

    /// What lies over the scene: marks, then panels.
    struct Cover {
        std::span<const shader::Mark> marks;
        const ImDrawData& panels;
    };

    /// Draws and shows, with whatever of the scene is drawn so far; waits for the frame before.
    /// @throws DeviceError
    Painted paint(const Scene& scene, const Cover& cover, const PaintWish& wish, FrameLog& log);

    /// For scripts: as if the window's surface were lost.
    void lose_surface() { swapchain_.lose_surface(); }

    /// The last frame that was kept. @throws DeviceError; InternalError before the first
    Picture picture();

    /// Several samples a pixel cost as much as so many windows where the CPU draws.
    bool draws_on_cpu() const;

  private:
    void wait();
    void record(const vk::raii::CommandBuffer& commands, const WindowImage& image, const Cover& cover,
                bool kept);
    void copy_picture(const vk::raii::CommandBuffer& commands, const WindowImage& image) const;
    void keep_picture(const vk::raii::CommandBuffer& commands, const WindowImage& image);

    DeviceState& device_;
    Swapchain swapchain_;
    MarksPass marks_;
    UiPass ui_;
    ScenePicture picture_;
    double handing_over_ = 0; ///< milliseconds that the last frame took
    Buffer pixels_;           ///< the last frame
    WindowSize pixels_size_;
    Commands commands_;
};

} // namespace anvil

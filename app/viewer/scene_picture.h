// The picture of a scene, over which the panels are drawn.
#pragma once

#include "app/viewer/disposer.h"
#include "app/viewer/frame_log.h"
#include "app/viewer/part_size.h"
#include "app/viewer/scene_pass.h"
#include "app/viewer/window.h"
#include "engine/gpu/render_target.h"

#include <memory>
#include <optional>
#include <vector>

namespace anvil {

/// A scene with one of each kind of thing that scenes have. @throws DeviceError
Scene scene_of_all_kinds(DeviceState& device);

/// How a picture is wanted.
struct PictureWish {
    WindowSize size;
    bool fine = false;   ///< several samples a pixel
    bool whole = false;  ///< at once, however long it takes
    bool steady = false; ///< the next scenes will have the same camera: what does not move is worth keeping
};

/// A scene that takes long grows in parts, one a frame, beside the picture before, which is shown until then.
/// A part that has begun to grow is finished before a newer scene begins, so that there is something new to
/// see while scenes change faster than they can be drawn; but what can be drawn in one part goes first.
/// Of a drag's scenes what does not move (parts_of()) is drawn once, with its depth, and kept: each step then
/// draws the region over a copy of it.
class ScenePicture {
  public:
    /// `window`: the format whose bytes are taken as they are. `in_parts`: scenes that take long may grow;
    /// else all are drawn at once. `disposer` gets the scenes that are no longer shown.
    ScenePicture(DeviceState& device, vk::Format window, bool in_parts, Disposer& disposer);

    /// Says what is drawn now for this scene to be seen. What an earlier call recorded is done.
    /// @throws DeviceError
    FrameKind prepare(const Scene& scene, const PictureWish& wish);
    void record(const vk::raii::CommandBuffer& commands);
    /// How many triangles and lines record() draws now.
    uint64_t draws_now() const { return draws_ ? part_end_ - grown_ : 0; }
    /// From the beginning of the recording until the device was done.
    void took(double milliseconds);

    /// Whether image() is, once the recording is done, the scene as it was wanted last.
    bool complete() const { return complete_; }
    /// The newest picture, to be copied from; not before record().
    vk::Image image() const { return shown_.drawn->target.colour(); }
    /// Of its surfaces, as shaders read them.
    vk::ImageView depths() const { return shown_.drawn->target.depths(); }
    WindowSize size() const { return shown_.drawn->size; }

  private:
    struct Drawn {
        RenderTarget target;
        WindowSize size;
    };
    /// Where scenes are drawn to, and how.
    struct Canvas {
        TargetFormat format;
        ScenePass pass;
        PartSize part_size;
        std::vector<std::shared_ptr<Drawn>> drawn;
    };
    /// A scene and its picture.
    struct Sight {
        std::optional<Scene> scene; ///< nothing: the picture is of none
        bool fine = false;
        std::shared_ptr<Drawn> drawn;

        bool serves(const Scene& wanted, const PictureWish& wish) const;
    };

    Canvas& canvas(bool fine);
    std::shared_ptr<Drawn> unused(Canvas& canvas, WindowSize size) const;
    std::optional<SceneParts> parts_for(const Scene& scene, const PictureWish& wish) const;
    bool goes_on(const Scene& scene, const PictureWish& wish) const;
    bool gives_way(const Scene& scene, const PictureWish& wish);
    void begin(const Scene& scene, const PictureWish& wish);
    void finish();
    const Scene& drawn_now() const { return rest_ ? *rest_ : *growing_.scene; }
    void drop(Sight& sight);

    DeviceState& device_;
    vk::Format format_;
    bool in_parts_;
    Disposer& disposer_;
    std::optional<Canvas> plain_;
    std::optional<Canvas> fine_;
    Sight shown_;
    Sight base_;                ///< what of scenes does not move; drawn: nullptr: none is kept
    Sight growing_;             ///< drawn: nullptr: none is
    bool grows_base_ = false;   ///< what grows is to be base_
    std::optional<Scene> rest_; ///< of what grows: drawn over base_; nothing: all is drawn
    bool base_pays_ = true;     ///< the last one was not given up
    uint64_t grown_ = 0;        ///< of its size
    uint64_t full_size_ = 0;    ///< of what grows
    uint64_t part_end_ = 0;     ///< what is drawn now: up to here
    bool draws_ = false;
    bool drew_fine_ = false;
    bool complete_ = false;
};

} // namespace anvil

// Drawing a line along the surface by clicks.
#pragma once

#include "app/viewer/drag_motion.h"
#include "app/viewer/input_event.h"
#include "app/viewer/picked.h"

#include <optional>

namespace anvil {

class LineTool {
  public:
    struct Finished {
        PickedLine line;
        bool further = false; ///< as a handle of its own, beside those that are there
    };

    /// A click sets a point; one at the first point closes the line and ends it, one at the last point ends
    /// it, as Enter does (with Shift: a further handle). Backspace takes the last point back, Escape all.
    /// Whether the event was the tool's; `surface` may be nullptr.
    bool handle(const InputEvent& event, const OrbitCamera& camera, const PickSurface* surface);

    /// What was ended since the last call; two points at least.
    std::optional<Finished> take();
    /// Under way; no points: none.
    const PickedLine& line() const { return line_; }
    /// What joins the points, if these are its points.
    void set_path(const std::vector<SurfaceAddress>& points, const std::vector<Vec3>& path);
    /// The points are where they are on another surface. `surface` may be nullptr: the line is dropped.
    void surface_changed(const PickSurface* surface);

  private:
    bool press(const InputEvent& event, const OrbitCamera& camera, const PickSurface* surface);
    bool key(const InputEvent& event);
    void finish(bool further);

    PickedLine line_;
    Cursor cursor_;
    std::optional<Finished> finished_;
};

} // namespace anvil

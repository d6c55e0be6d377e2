// The edit that a person is making with mouse and keys: where its handles are picked and how they are moved.
// No window, no device: events in, edits out.
#pragma once

#include "app/viewer/handle_drag.h"

#include <optional>
#include <string>
#include <vector>

namespace anvil {

/// What a click on the surface does.
/// Lines and the selection are made by tools of their own.
enum class Tool : uint8_t { move, turn, anchor, pin, line, select };

/// What the editor wants done with its edit.
enum class EditorWish : uint8_t { nothing, preview, commit, drop };

class Editor {
  public:
    double radius = 1; ///< world
    ShapeChoice shape;
    std::optional<Refine> refine;
    std::optional<Mirror> mirror;
    Metric metric = Metric::geodesic;
    Tool tool = Tool::move;
    bool follow_path = false; ///< handles take the way that they are dragged, not the straight one

    /// Whether the event was the editor's; `surface` may be nullptr. Afterwards ask for wish().
    bool handle(const InputEvent& event, const OrbitCamera& camera, const PickSurface* surface);

    /// What became of the edit since the last call.
    EditorWish take_wish();
    /// The edit as it stands; at least one handle.
    Edit edit() const;
    bool has_handles() const { return !handles_.all.empty(); }
    /// Forgets handles, anchors and pins.
    void clear();
    /// Looks again at what is under the cursor; `surface` may be nullptr.
    void surface_changed(const OrbitCamera& camera, const PickSurface* surface);
    /// After a change of radius, shape, metric or refinement by a panel.
    void settings_changed();

    bool dragging() const { return drag_.has_value(); }
    const std::vector<PickedHandle>& handles() const { return handles_.all; }
    const std::vector<PickedPlace>& pins() const { return pins_; }
    /// Pins of this and all further edits, until others are given.
    const std::vector<PickedPlace>& lasting_pins() const { return lasting_pins_; }
    void set_lasting_pins(std::vector<PickedPlace> pins);
    /// As an anchor of the active handle; without handles, or as a `further` one, as a handle that is the
    /// whole line, held at its middle point. @pre two points
    void add_line(const PickedLine& line, bool further);
    /// What joins the points of lines with these points.
    void set_path(const std::vector<SurfaceAddress>& points, const std::vector<Vec3>& path);
    /// What the active handle's distances are measured from, beside what it has. @pre has_handles()
    void add_anchors(const std::vector<PickedFace>& faces, const std::vector<PickedPlace>& places);
    size_t active() const { return handles_.active; }
    const std::optional<SurfaceHit>& hover() const { return hover_; }
    /// Where a handle is wanted.
    Vec3 target(const PickedHandle& handle) const { return handles_.target(handle); }
    /// Of rotations: through the drag's centre.
    const Axis& axis() const { return handles_.axis; }
    /// One line for the status bar: what goes on and which keys matter now.
    std::string hint() const;

    /// Picks as a click with the tool does; for scripts.
    void pick(const SurfaceHit& hit, bool further);

  private:
    bool press(const InputEvent& event, const OrbitCamera& camera, const PickSurface* surface);
    bool key(const InputEvent& event, const OrbitCamera& camera);
    bool drag_key(const InputEvent& event, const OrbitCamera& camera);
    void begin(bool modal, bool picked_new, const OrbitCamera& camera);
    void apply(const OrbitCamera& camera, bool snap);
    void note_way();
    void finish();
    void cancel();
    std::optional<size_t> handle_at(const OrbitCamera& camera, double x, double y) const;

    Cursor cursor_;
    PickedHandles handles_;
    std::vector<PickedPlace> pins_;
    std::vector<PickedPlace> lasting_pins_;
    std::optional<SurfaceHit> hover_;
    std::optional<HandleDrag> drag_;
    EditorWish wish_ = EditorWish::nothing;
    bool snapping_ = false;
};

} // namespace anvil

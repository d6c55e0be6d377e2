// The edit that a person is making with mouse and keys: where its handles are picked and how they are moved.
// No window, no device: events in, edits out.
#pragma once

#include "app/viewer/drag_motion.h"
#include "app/viewer/input_event.h"
#include "app/viewer/pick_surface.h"
#include "engine/edit/recipe.h"

#include <optional>
#include <string>
#include <vector>

namespace anvil {

/// What a click on the surface does.
enum class Tool : uint8_t { move, turn, anchor, pin };

/// A picked place with where it was when it was picked.
struct PickedPlace {
    SurfaceAddress at;
    Vec3 position{0};
    Vec3 normal{0};
};

struct PickedHandle {
    PickedPlace place;
    Vec3 by{0};
    double degrees = 0;
    std::vector<PickedPlace> anchors;
};

/// What the editor wants done with its edit.
enum class EditorWish : uint8_t { nothing, preview, commit, drop };

class Editor {
  public:
    Tool tool = Tool::move;
    double radius = 1; ///< world
    ShapeChoice shape;
    Metric metric = Metric::geodesic;
    std::optional<Refine> refine;

    /// Whether the event was the editor's; `surface` may be nullptr. Afterwards ask for wish().
    bool handle(const InputEvent& event, const OrbitCamera& camera, const PickSurface* surface);

    /// What became of the edit since the last call.
    EditorWish take_wish();
    /// The edit as it stands; at least one handle.
    Edit edit() const;
    bool has_handles() const { return !handles_.empty(); }
    /// Forgets handles, anchors and pins.
    void clear();
    /// After a change of radius, shape, metric or refinement by a panel.
    void settings_changed();

    bool dragging() const { return drag_.has_value(); }
    const std::vector<PickedHandle>& handles() const { return handles_; }
    const std::vector<PickedPlace>& pins() const { return pins_; }
    size_t active() const { return active_; }
    const std::optional<SurfaceHit>& hover() const { return hover_; }
    /// Where a handle is wanted.
    Vec3 target(const PickedHandle& handle) const;
    /// Of rotations: through the drag's centre.
    const Axis& axis() const { return axis_; }
    /// One line for the status bar: what goes on and which keys matter now.
    std::string hint() const;

    /// Picks as a click with the tool does; for scripts.
    void pick(const SurfaceHit& hit, bool further);

  private:
    /// A drag under way.
    struct Drag {
        bool modal = false; ///< follows the cursor without a button, until Enter or a click
        Cursor start;
        Cursor now;  ///< moves slower than the cursor while Shift is held
        Cursor last; ///< the cursor itself
        DragConstraint constraint;
        std::string constraint_name;
        std::string typed;
        std::vector<PickedHandle> before;
        bool picked_new = false; ///< begun by the press that picked its handle
        double turned = 0;       ///< degrees, over several turns
    };

    bool press(const InputEvent& event, const OrbitCamera& camera, const PickSurface* surface);
    bool key(const InputEvent& event, const OrbitCamera& camera);
    bool drag_key(const InputEvent& event, const OrbitCamera& camera);
    bool type(uint32_t character);
    void begin(bool modal, bool picked_new, const OrbitCamera& camera);
    void move(const InputEvent& event, const OrbitCamera& camera);
    void apply(const OrbitCamera& camera, bool snap);
    void apply_move(const OrbitCamera& camera, bool snap);
    void apply_turn(bool snap);
    void constrain(const Vec3& direction, const std::string& name, bool plane);
    void finish();
    void cancel();
    std::optional<size_t> handle_at(const OrbitCamera& camera, double x, double y) const;
    void set_axis(const Vec3& direction);
    std::optional<double> typed_value() const;

    std::vector<PickedHandle> handles_;
    std::vector<PickedPlace> pins_;
    size_t active_ = 0;
    std::optional<SurfaceHit> hover_;
    std::optional<Drag> drag_;
    Axis axis_;
    bool turns_ = false; ///< the edit is a rotation
    EditorWish wish_ = EditorWish::nothing;
    Cursor cursor_;
    bool snapping_ = false;
};

} // namespace anvil

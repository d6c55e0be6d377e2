// The marks on an occluder that move, turn and scale it: where the window shows them, and what a drag of one
// does to its transform. No window.
#pragma once

#include "app/viewer/drag_motion.h"
#include "app/viewer/input_event.h"
#include "app/viewer/typed_number.h"
#include "engine/edit/recipe.h"

#include <array>
#include <string>
#include <vector>

namespace anvil {

/// What a mark does. Axes are those of the world; `across` moves in the plane across the axis.
enum class GizmoAction : uint8_t { none, move_freely, move, across, turn, turn_in_view, scale };

struct GizmoPart {
    GizmoAction action = GizmoAction::none;
    int axis = 0; ///< x 0, y, z: of move, across and turn

    bool operator==(const GizmoPart&) const = default;
    explicit operator bool() const { return action != GizmoAction::none; }
};

/// A mark in the window.
struct GizmoMark {
    GizmoPart part;
    std::vector<glm::dvec2> line; ///< pixels
    bool filled = false;          ///< a face, grabbed anywhere inside
};

/// All marks around a place, those on top last; none where it is behind the eye. They are as large in the
/// window whatever the distance; axes that run along the view and what of a ring is behind are left out.
std::vector<GizmoMark> gizmo_marks(const OrbitCamera& camera, const Vec3& centre);

/// The mark at a place of the window, or none.
GizmoPart gizmo_part_at(const std::vector<GizmoMark>& marks, double x, double y);

/// The transform and then a turn about the axis (not zero, right-handed) through `pivot` (world). About the
/// axis that it is turned about already, the angles add up, beyond 360 degrees too.
Transform turned_about(const Transform& transform, const Vec3& axis, double degrees, const Vec3& pivot);

/// The transform and then a scaling by `factor` > 0 about `pivot` (world).
Transform scaled_about(const Transform& transform, double factor, const Vec3& pivot);

/// A drag of a mark under way.
class GizmoDrag {
  public:
    /// `pivot`: where the marks are (world); `step`: lengths snap to multiples of it.
    GizmoDrag(GizmoPart part, const Transform& start, const Vec3& pivot, const Cursor& cursor, double step);

    /// Shift: a tenth of the cursor's way; Ctrl: whole steps.
    void move(const InputEvent& event, const OrbitCamera& camera);
    /// X, Y, Z: along or about that axis (Shift: in the plane across it); Backspace. Whether it was one.
    bool key(const InputEvent& event, const OrbitCamera& camera);
    bool type(uint32_t character, const OrbitCamera& camera);

    const Transform& now() const { return now_; }
    /// At a share of the way from the start, in [0, 1].
    Transform at(double share) const;
    /// How far it turned, without sign; 0 of other drags.
    double degrees() const;
    bool is_typed() const { return !typed_.empty(); }
    /// The cursor went farther than a click does, or a number was typed.
    bool moved() const;
    GizmoPart part() const { return part_; }
    /// One line: what goes on.
    std::string hint() const;

  private:
    bool turns() const {
        return part_.action == GizmoAction::turn || part_.action == GizmoAction::turn_in_view;
    }
    void apply(const OrbitCamera& camera);
    void apply_turn(const OrbitCamera& camera);
    void apply_move(const OrbitCamera& camera);
    void apply_scale(const OrbitCamera& camera);
    Vec3 turn_axis(const OrbitCamera& camera) const;

    GizmoPart part_;
    Transform start_;
    Transform now_;
    Vec3 pivot_;
    double step_;
    Cursor from_;
    Cursor to_;   ///< goes slower than the cursor while Shift is held
    Cursor last_; ///< the cursor itself
    bool snaps_ = false;
    double turned_ = 0;  ///< degrees, over several turns
    double amount_ = 0;  ///< degrees, factor or length of the drag
    Vec3 axis_{0, 1, 0}; ///< of the last turn
    TypedNumber typed_;
};

} // namespace anvil

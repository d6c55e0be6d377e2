// Occluders under mouse and keys: which one is selected, its gizmo, and the motion of a hammer that is
// recorded. No window, no device: events in, transforms out.
#pragma once

#include "app/viewer/gizmo.h"
#include "app/viewer/pick_surface.h"
#include "app/viewer/shown_occluder.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace anvil {

/// What the tool wants done.
enum class OccluderWish : uint8_t {
    nothing,
    preview, ///< shown() or motions() changed
    moved,   ///< the selected one is to stand where shown() says
};

class OccluderTool {
  public:
    bool records = false; ///< drags are a hammer's motion; the occluder stays where it is
    bool picks = false;   ///< clicks select occluders alone; else only where no surface is under the cursor

    /// How large the scene is, world: for snapping and for what of a motion is kept. @pre size > 0
    void set_scene_size(double size);

    /// Whether the event was the tool's. `surface` may be nullptr.
    bool handle(const InputEvent& event, const OrbitCamera& camera, std::span<const OccluderView> occluders,
                const PickSurface* surface);
    OccluderWish take_wish();

    const std::string& selected() const { return selected_; } ///< empty: none
    void select(const std::string& name);
    bool dragging() const { return drag_.has_value(); }
    /// The mark under the cursor, or that is dragged.
    GizmoPart hot() const { return drag_ ? drag_->part() : hot_; }
    /// Where an occluder is to be drawn: in mid-drag, and at the end of what was recorded.
    Transform shown(const OccluderView& occluder) const;
    /// The marks of the selected one.
    std::vector<GizmoMark> marks(const OrbitCamera& camera, std::span<const OccluderView> occluders) const;
    /// While it is dragged.
    std::string hint() const { return drag_->hint() + (records_now() ? "   (recorded)" : ""); }

    /// By the name of the occluder; the one under way included.
    std::map<std::string, std::vector<MotionPose>> motions() const;
    bool has_motion() const { return !samples_.empty() || (dragging() && records_now()); }
    /// The places that a recorded occluder went through.
    const std::map<std::string, std::vector<Transform>>& samples() const { return samples_; }
    void clear_motions();

    /// What was asked for has been done or refused: occluders stand where their views say.
    void settle() { taken_.reset(); }

  private:
    bool press(const InputEvent& event, const OrbitCamera& camera, std::span<const OccluderView> occluders,
               const PickSurface* surface);
    bool key(const InputEvent& event, const OrbitCamera& camera);
    bool records_now() const { return records || samples_.contains(selected_); }
    void sample();
    void finish();
    void cancel();
    const OccluderView* find(std::span<const OccluderView> occluders) const;

    std::string selected_;
    std::optional<GizmoDrag> drag_;
    GizmoPart hot_;
    Cursor cursor_;
    std::vector<Transform> way_; ///< of the drag under way, recorded
    std::map<std::string, std::vector<Transform>> samples_;
    std::optional<Transform> taken_; ///< where the selected one is to stand
    OccluderWish wish_ = OccluderWish::nothing;
    double size_ = 1;
};

} // namespace anvil

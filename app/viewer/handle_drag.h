// A drag of an edit's handles under way: what mouse and keys make of them.
#pragma once

#include "app/viewer/drag_motion.h"
#include "app/viewer/input_event.h"
#include "app/viewer/picked.h"
#include "app/viewer/typed_number.h"

#include <optional>
#include <string>
#include <vector>

namespace anvil {

class HandleDrag {
  public:
    /// `modal`: it follows the cursor without a button, until Enter or a click. `picked_new`: begun by the
    /// press that picked its handle. Turns begin about the view axis. @pre there are handles
    HandleDrag(PickedHandles& handles, const OrbitCamera& camera, const Cursor& start, bool modal,
               bool picked_new);

    bool modal() const { return modal_; }
    bool picked_new() const { return picked_new_; }
    /// The handles when it began.
    const std::vector<PickedHandle>& before() const { return before_; }
    /// Whether it is more than a click.
    bool moved() const;
    /// The same, or that it came back from farther.
    bool went() const { return went_ || moved(); }
    bool typed() const { return !typed_.empty(); }

    void move(const InputEvent& event, const OrbitCamera& camera, const PickedHandles& handles);
    /// An axis, a plane or a digit less; false: none of these.
    bool key(const InputEvent& event, const OrbitCamera& camera, PickedHandles& handles);
    /// A digit, sign or point; false: none of these.
    bool type(uint32_t character);
    /// Moves the handles to where all this says. Snapping goes by steps that fit the radius.
    void apply(const OrbitCamera& camera, double radius, bool snap, PickedHandles& handles) const;

    /// What it is held to and how far it is, for people.
    std::string description(const PickedHandles& handles) const;

  private:
    double turn_by(bool snap) const;
    Vec3 move_by(const OrbitCamera& camera, double radius, bool snap, const PickedHandles& handles) const;
    void constrain(const Vec3& direction, const std::string& name, bool plane);

    bool modal_;
    bool picked_new_;
    Cursor start_;
    Cursor now_;  ///< moves slower than the cursor while Shift is held
    Cursor last_; ///< the cursor itself
    DragConstraint constraint_;
    std::string constraint_name_;
    TypedNumber typed_;
    std::vector<PickedHandle> before_;
    bool went_ = false;
    double turned_ = 0; ///< degrees, over several turns
};

} // namespace anvil

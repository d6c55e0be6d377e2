#include "app/viewer/handle_drag.h"

#include "app/viewer/window.h"
#include "engine/core/number_text.h"

#include <cmath>

namespace anvil {

namespace {

constexpr double still_pixels = 3; ///< a press that moves less is a click
constexpr double precise = 0.1;
constexpr double turn_step = 15;

} // namespace

HandleDrag::HandleDrag(PickedHandles& handles, const OrbitCamera& camera, const Cursor& start, bool modal,
                       bool picked_new)
    : modal_(modal), picked_new_(picked_new), start_(start), now_(start), last_(start), before_(handles.all) {
    if (handles.turns) {
        handles.axis = {handles.centre(), -camera.forward()};
        for (PickedHandle& handle : handles.all) {
            handle.by = Vec3(0);
        }
    }
}

bool HandleDrag::moved() const {
    return std::abs(now_.x - start_.x) + std::abs(now_.y - start_.y) > still_pixels || !typed_.empty();
}

void HandleDrag::move(const InputEvent& event, const OrbitCamera& camera, const PickedHandles& handles) {
    const double factor = event.modifiers.shift ? precise : 1;
    const Cursor before = now_;
    now_.x += (event.x - last_.x) * factor;
    now_.y += (event.y - last_.y) * factor;
    last_ = {event.x, event.y};
    went_ = went_ || moved();
    if (handles.turns) {
        turned_ += turned(camera, handles.axis.origin, handles.axis.direction, before, now_);
    }
}

void HandleDrag::apply(const OrbitCamera& camera, double radius, bool snap, PickedHandles& handles) const {
    PickedHandle& handle = handles.all[handles.active];
    const PickedHandle& begun = before_[handles.active];
    if (handles.turns) {
        handle.degrees = begun.degrees + turn_by(snap);
    } else {
        handle.by = begun.by + move_by(camera, radius, snap, handles);
    }
}

double HandleDrag::turn_by(bool snap) const {
    const double degrees = snap ? to_multiple(turned_, turn_step) : turned_;
    return typed_.value().value_or(degrees);
}

Vec3 HandleDrag::move_by(const OrbitCamera& camera, double radius, bool snap,
                         const PickedHandles& handles) const {
    const PickedHandle& begun = before_[handles.active];
    const bool on_axis = constraint_.kind == DragConstraint::Kind::axis;
    if (const auto value = typed_.value()) {
        const Vec3 along = on_axis ? constraint_.direction : begun.place.normal;
        const double length = glm::length(along);
        return length > 0 ? *value / length * along : Vec3(0);
    }
    const Vec3 by = dragged(camera, begun.place.position + begun.by, start_, now_, constraint_);
    if (!snap) {
        return by;
    }
    const double step = round_step(10 * radius);
    if (on_axis) {
        const Vec3 along = glm::normalize(constraint_.direction);
        return to_multiple(glm::dot(by, along), step) * along;
    }
    return {to_multiple(by.x, step), to_multiple(by.y, step), to_multiple(by.z, step)};
}

void HandleDrag::constrain(const Vec3& direction, const std::string& name, bool plane) {
    const DragConstraint wanted{plane ? DragConstraint::Kind::plane : DragConstraint::Kind::axis, direction};
    const bool again = constraint_ == wanted;
    constraint_ = again ? DragConstraint{} : wanted;
    constraint_name_ = again ? "" : plane ? "in the plane across " + name : "along " + name;
}

bool HandleDrag::key(const InputEvent& event, const OrbitCamera& camera, PickedHandles& handles) {
    const int number = event.key;
    const Vec3& normal = handles.all[handles.active].place.normal;
    if (number == key_of("backspace") && !typed_.empty()) {
        typed_.erase_last();
    } else if (number >= 'X' && number <= 'Z') {
        Vec3 axis(0);
        axis[number - 'X'] = 1;
        const std::string name(1, static_cast<char>(number));
        if (handles.turns) {
            Vec3& direction = handles.axis.direction;
            direction = direction == axis ? -camera.forward() : axis;
            constraint_name_ = direction == axis ? "about " + name : "";
        } else {
            constrain(axis, name, event.modifiers.shift);
        }
    } else if (number == 'N' && normal != Vec3(0)) {
        if (handles.turns) {
            handles.axis.direction = normal;
            constraint_name_ = "about the normal";
        } else {
            constrain(normal, "the normal", event.modifiers.shift);
        }
    } else {
        return false;
    }
    return true;
}

bool HandleDrag::type(uint32_t character) {
    return typed_.type(character);
}

std::string HandleDrag::description(const PickedHandles& handles) const {
    const PickedHandle& handle = handles.all[handles.active];
    const std::string amount = handles.turns ? rounded_text(handle.degrees) + " degrees"
                                             : "by " + rounded_text(glm::length(handle.by));
    return (handles.turns ? "Turn " : "Move ") + constraint_name_ + (constraint_name_.empty() ? "" : ", ") +
           amount + (typed_.empty() ? "" : " (typed " + typed_.text() + ")");
}

} // namespace anvil

#include "app/viewer/gizmo.h"

#include "app/viewer/window.h"
#include "engine/core/number_text.h"

#include <algorithm>

namespace anvil {

namespace {

constexpr double still_pixels = 3; ///< a press that moves less is a click
constexpr double precise = 0.1;
constexpr double turn_step = 15;
constexpr double scale_step = 0.1;
constexpr double least_scale = 1e-3; ///< of the start's

Vec3 unit_axis(int axis) {
    Vec3 unit(0);
    unit[axis] = 1;
    return unit;
}

glm::dquat rotation_of(const Transform& transform) {
    return glm::angleAxis(glm::radians(transform.degrees), glm::normalize(transform.axis));
}

/// For rings seen from their side, where the cursor's angle about the centre says nothing: by its way along
/// the ring.
double turned_along(const OrbitCamera& camera, const Vec3& centre, const Vec3& axis, const Cursor& from,
                    const Cursor& to) {
    const ScreenPoint middle = camera.project(centre);
    const Vec3 towards_eye = -camera.forward();
    const Vec3 way = glm::cross(axis, towards_eye); // of the ring's front
    const double pixel = camera.pixel_size(middle.depth);
    const ScreenPoint next = camera.project(centre + 100 * pixel * glm::normalize(way));
    const glm::dvec2 along(next.x - middle.x, next.y - middle.y);
    const double length = glm::length(along);
    if (!(length > 0)) {
        return 0;
    }
    const double pixels = glm::dot(glm::dvec2(to.x - from.x, to.y - from.y), along) / length;
    return glm::degrees(pixels / 100);
}

} // namespace

Transform turned_about(const Transform& transform, const Vec3& axis, double degrees, const Vec3& pivot) {
    const Vec3 unit = glm::normalize(axis);
    const glm::dquat turn = glm::angleAxis(glm::radians(degrees), unit);
    Transform result = transform;
    result.translate = pivot + turn * (transform.translate - pivot);
    const double same = glm::dot(glm::normalize(transform.axis), unit);
    if (transform.degrees == 0) {
        result.axis = unit;
        result.degrees = degrees;
    } else if (std::abs(same) > 1 - 1e-12) {
        result.degrees += same > 0 ? degrees : -degrees;
    } else {
        const glm::dquat both = glm::normalize(turn * rotation_of(transform));
        const double angle = glm::angle(both);
        result.axis = angle > 0 ? glm::axis(both) : unit;
        result.degrees = glm::degrees(angle);
    }
    return result;
}

Transform scaled_about(const Transform& transform, double factor, const Vec3& pivot) {
    Transform result = transform;
    result.scale *= factor;
    result.translate = pivot + factor * (transform.translate - pivot);
    return result;
}

GizmoDrag::GizmoDrag(GizmoPart part, const Transform& start, const Vec3& pivot, const Cursor& cursor,
                     double step)
    : part_(part), start_(start), now_(start), pivot_(pivot), step_(step), from_(cursor), to_(cursor),
      last_(cursor) {}

bool GizmoDrag::moved() const {
    return std::hypot(last_.x - from_.x, last_.y - from_.y) > still_pixels || !typed_.empty();
}

Vec3 GizmoDrag::turn_axis(const OrbitCamera& camera) const {
    return part_.action == GizmoAction::turn ? unit_axis(part_.axis) : -camera.forward();
}

void GizmoDrag::move(const InputEvent& event, const OrbitCamera& camera) {
    const double factor = event.modifiers.shift ? precise : 1;
    const Cursor before = to_;
    to_.x += (event.x - last_.x) * factor;
    to_.y += (event.y - last_.y) * factor;
    last_ = {event.x, event.y};
    snaps_ = event.modifiers.control;
    const Vec3 axis = turn_axis(camera);
    const bool from_the_side = std::abs(glm::dot(axis, camera.forward())) < 0.3;
    turned_ += from_the_side ? turned_along(camera, pivot_, axis, before, to_)
                             : turned(camera, pivot_, axis, before, to_);
    apply(camera);
}

bool GizmoDrag::key(const InputEvent& event, const OrbitCamera& camera) {
    if (event.key == key_of("backspace")) {
        typed_.erase_last();
    } else if (event.key >= 'X' && event.key <= 'Z' && part_.action != GizmoAction::scale) {
        const bool turns_it = turns();
        part_.axis = event.key - 'X';
        part_.action = turns_it                ? GizmoAction::turn
                       : event.modifiers.shift ? GizmoAction::across
                                               : GizmoAction::move;
    } else {
        return false;
    }
    apply(camera);
    return true;
}

bool GizmoDrag::type(uint32_t character, const OrbitCamera& camera) {
    if (!typed_.type(character)) {
        return false;
    }
    apply(camera);
    return true;
}

void GizmoDrag::apply(const OrbitCamera& camera) {
    if (turns()) {
        apply_turn(camera);
    } else if (part_.action == GizmoAction::scale) {
        apply_scale(camera);
    } else {
        apply_move(camera);
    }
}

Transform GizmoDrag::at(double share) const {
    if (turns()) {
        return turned_about(start_, axis_, share * amount_, pivot_);
    }
    if (part_.action == GizmoAction::scale) {
        return scaled_about(start_, std::pow(now_.scale / start_.scale, share), pivot_);
    }
    Transform result = start_;
    result.translate += share * (now_.translate - start_.translate);
    return result;
}

double GizmoDrag::degrees() const {
    return turns() ? std::abs(amount_) : 0;
}

void GizmoDrag::apply_turn(const OrbitCamera& camera) {
    const double degrees = snaps_ ? to_multiple(turned_, turn_step) : turned_;
    amount_ = typed_.value().value_or(degrees);
    axis_ = turn_axis(camera);
    now_ = turned_about(start_, axis_, amount_, pivot_);
}

void GizmoDrag::apply_move(const OrbitCamera& camera) {
    DragConstraint constraint;
    if (part_.action != GizmoAction::move_freely) {
        constraint.kind =
            part_.action == GizmoAction::move ? DragConstraint::Kind::axis : DragConstraint::Kind::plane;
        constraint.direction = unit_axis(part_.axis);
    }
    Vec3 by = dragged(camera, pivot_, from_, to_, constraint);
    const auto value = typed_.value();
    if (value && part_.action == GizmoAction::move) {
        by = *value * constraint.direction;
    } else if (value && glm::length(by) > 0) {
        by = *value * glm::normalize(by); // that far where the cursor goes
    } else if (snaps_) {
        by = Vec3(to_multiple(by.x, step_), to_multiple(by.y, step_), to_multiple(by.z, step_));
    }
    amount_ = glm::length(by);
    now_ = start_;
    now_.translate += by;
}

void GizmoDrag::apply_scale(const OrbitCamera& camera) {
    const ScreenPoint middle = camera.project(pivot_);
    const double before = std::hypot(from_.x - middle.x, from_.y - middle.y);
    const double after = std::hypot(to_.x - middle.x, to_.y - middle.y);
    double factor = before > 1 ? after / before : 1;
    factor = snaps_ ? to_multiple(factor, scale_step) : factor;
    factor = std::max(typed_.value().value_or(factor), least_scale);
    amount_ = factor;
    now_ = scaled_about(start_, factor, pivot_);
}

std::string GizmoDrag::hint() const {
    const std::string axis(1, "XYZ"[part_.axis]);
    std::string text;
    switch (part_.action) {
    case GizmoAction::turn:
        text = "Turn about " + axis + ", " + rounded_text(amount_) + " degrees";
        break;
    case GizmoAction::turn_in_view:
        text = "Turn, " + rounded_text(amount_) + " degrees";
        break;
    case GizmoAction::scale:
        text = "Scale by " + rounded_text(amount_);
        break;
    case GizmoAction::move:
        text = "Move along " + axis + ", by " + rounded_text(amount_);
        break;
    case GizmoAction::across:
        text = "Move in the plane across " + axis + ", by " + rounded_text(amount_);
        break;
    default:
        text = "Move, by " + rounded_text(amount_);
    }
    return text + (typed_.empty() ? "" : " (typed " + typed_.text() + ")") +
           "   X Y Z: axis   Shift+X Y Z: plane   digits: how far   Ctrl: snap   Shift: precise   Esc: "
           "cancel";
}

} // namespace anvil

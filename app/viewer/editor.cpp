#include "app/viewer/editor.h"

#include "app/viewer/navigation.h"
#include "app/viewer/window.h"
#include "engine/core/number_text.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace anvil {

namespace {

constexpr double grab_pixels = 12;
constexpr double still_pixels = 3; ///< a press that moves less is a click
constexpr double precise = 0.1;
constexpr double turn_step = 15;

PickedPlace place_of(const SurfaceHit& hit) {
    return {hit.address, hit.position, hit.normal};
}

Vec3 centre_of(const std::vector<PickedHandle>& handles) {
    Vec3 sum(0);
    size_t count = 0;
    for (const PickedHandle& handle : handles) {
        for (const PickedPlace& anchor : handle.anchors) {
            sum += anchor.position;
            ++count;
        }
    }
    return count > 0 ? sum / static_cast<double>(count) : handles.front().place.position;
}

Vec3 rotated(const Vec3& p, const Axis& axis, double degrees) {
    const glm::dquat turn = glm::angleAxis(glm::radians(degrees), glm::normalize(axis.direction));
    return axis.origin + turn * (p - axis.origin);
}

} // namespace

EditorWish Editor::take_wish() {
    return std::exchange(wish_, EditorWish::nothing);
}

void Editor::clear() {
    handles_.clear();
    pins_.clear();
    drag_.reset();
    active_ = 0;
    turns_ = false;
}

void Editor::settings_changed() {
    if (has_handles()) {
        wish_ = EditorWish::preview;
    }
}

Vec3 Editor::target(const PickedHandle& handle) const {
    return turns_ ? rotated(handle.place.position, axis_, handle.degrees) : handle.place.position + handle.by;
}

Edit Editor::edit() const {
    Edit edit;
    edit.kind = turns_ ? EditKind::rotate : EditKind::translate;
    if (turns_) {
        edit.axis = axis_;
    }
    edit.radius = radius;
    edit.shape = shape;
    edit.metric = metric;
    edit.refine = refine;
    for (const PickedHandle& picked : handles_) {
        Handle& handle = edit.handles.emplace_back();
        handle.at = picked.place.at;
        if (turns_) {
            handle.degrees = picked.degrees;
        } else {
            handle.by = picked.by;
        }
        if (!picked.anchors.empty()) {
            Anchors& anchors = edit.anchors.emplace_back();
            anchors.handle = static_cast<uint32_t>(edit.handles.size() - 1);
            for (const PickedPlace& place : picked.anchors) {
                anchors.at.emplace_back(place.at);
            }
        }
    }
    for (const PickedPlace& pin : pins_) {
        edit.pinned.push_back(pin.at);
    }
    return edit;
}

std::optional<size_t> Editor::handle_at(const OrbitCamera& camera, double x, double y) const {
    std::optional<size_t> best;
    double nearest = grab_pixels;
    for (size_t i = 0; i < handles_.size(); ++i) {
        const ScreenPoint at = camera.project(target(handles_[i]));
        const double away = std::hypot(at.x - x, at.y - y);
        if (at.visible() && away <= nearest) {
            nearest = away;
            best = i;
        }
    }
    return best;
}

void Editor::pick(const SurfaceHit& hit, bool further) {
    const PickedPlace place = place_of(hit);
    if (tool == Tool::pin) {
        pins_.push_back(place);
    } else if (tool == Tool::anchor && has_handles()) {
        handles_[active_].anchors.push_back(place);
    } else {
        if (!further) {
            clear();
        }
        handles_.push_back({place, Vec3(0), 0, {}});
        active_ = handles_.size() - 1;
        turns_ = tool == Tool::turn;
    }
    settings_changed();
}

bool Editor::handle(const InputEvent& event, const OrbitCamera& camera, const PickSurface* surface) {
    snapping_ = event.kind == InputEvent::Kind::text ? snapping_ : event.modifiers.control;
    switch (event.kind) {
    case InputEvent::Kind::move:
        cursor_ = {event.x, event.y};
        if (drag_) {
            move(event, camera);
            return true;
        }
        hover_ = surface != nullptr ? surface->hit(camera.ray(event.x, event.y)) : std::nullopt;
        return false;
    case InputEvent::Kind::press:
        return press(event, camera, surface);
    case InputEvent::Kind::release:
        if (drag_ && !drag_->modal && event.button == MouseButton::left) {
            finish();
            return true;
        }
        return false;
    case InputEvent::Kind::scroll:
        if (drag_ || (has_handles() && event.modifiers.control)) {
            radius *= Navigation::wheel_factor(event.y * (event.modifiers.shift ? precise : 1));
            settings_changed();
            return true;
        }
        return false;
    case InputEvent::Kind::key_down:
        return drag_ ? drag_key(event, camera) : key(event, camera);
    case InputEvent::Kind::text:
        if (drag_ && type(event.character)) {
            apply(camera, snapping_);
            return true;
        }
        return false;
    default:
        return false;
    }
}

bool Editor::press(const InputEvent& event, const OrbitCamera& camera, const PickSurface* surface) {
    if (drag_) {
        if (drag_->modal && event.button == MouseButton::left) {
            finish();
        } else if (event.button == MouseButton::right) {
            cancel();
        }
        return true;
    }
    if (event.button != MouseButton::left || event.modifiers.alt) {
        return false;
    }
    const auto grabbed = handle_at(camera, cursor_.x, cursor_.y);
    const bool grabs = tool == Tool::move || tool == Tool::turn;
    if (grabbed && grabs) {
        active_ = *grabbed;
        begin(false, false, camera);
        return true;
    }
    hover_ = surface != nullptr ? surface->hit(camera.ray(cursor_.x, cursor_.y)) : std::nullopt;
    if (!hover_) {
        return false;
    }
    pick(*hover_, event.modifiers.shift);
    if (grabs) {
        begin(false, true, camera);
    }
    return true;
}

void Editor::begin(bool modal, bool picked_new, const OrbitCamera& camera) {
    Drag drag;
    drag.modal = modal;
    drag.start = drag.now = drag.last = cursor_;
    drag.before = handles_;
    drag.picked_new = picked_new;
    drag_ = std::move(drag);
    turns_ = tool == Tool::turn;
    if (turns_) {
        set_axis(-camera.forward());
        for (PickedHandle& handle : handles_) {
            handle.by = Vec3(0);
        }
    }
    settings_changed();
}

void Editor::set_axis(const Vec3& direction) {
    axis_ = {centre_of(handles_), direction};
}

void Editor::move(const InputEvent& event, const OrbitCamera& camera) {
    const double factor = event.modifiers.shift ? precise : 1;
    const Cursor before = drag_->now;
    drag_->now.x += (event.x - drag_->last.x) * factor;
    drag_->now.y += (event.y - drag_->last.y) * factor;
    drag_->last = {event.x, event.y};
    if (turns_) {
        drag_->turned += turned(camera, axis_.origin, axis_.direction, before, drag_->now);
    }
    apply(camera, event.modifiers.control);
}

std::optional<double> Editor::typed_value() const {
    double value = 0;
    const std::string& text = drag_->typed;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && std::isfinite(value)
               ? std::optional(value)
               : std::nullopt;
}

void Editor::apply(const OrbitCamera& camera, bool snap) {
    if (turns_) {
        apply_turn(snap);
    } else {
        apply_move(camera, snap);
    }
    wish_ = EditorWish::preview;
}

void Editor::apply_turn(bool snap) {
    double degrees = snap ? to_multiple(drag_->turned, turn_step) : drag_->turned;
    degrees = typed_value().value_or(degrees);
    handles_[active_].degrees = drag_->before[active_].degrees + degrees;
}

void Editor::apply_move(const OrbitCamera& camera, bool snap) {
    PickedHandle& handle = handles_[active_];
    const Vec3 start = drag_->before[active_].place.position + drag_->before[active_].by;
    Vec3 by = dragged(camera, start, drag_->start, drag_->now, drag_->constraint);
    if (const auto value = typed_value()) {
        const bool axis = drag_->constraint.kind == DragConstraint::Kind::axis;
        const Vec3 along = axis ? drag_->constraint.direction : handle.place.normal;
        const double length = glm::length(along);
        by = length > 0 ? *value / length * along : Vec3(0);
    } else if (snap) {
        const double step = round_step(10 * radius);
        if (drag_->constraint.kind == DragConstraint::Kind::axis) {
            const Vec3 along = glm::normalize(drag_->constraint.direction);
            by = to_multiple(glm::dot(by, along), step) * along;
        } else {
            by = Vec3(to_multiple(by.x, step), to_multiple(by.y, step), to_multiple(by.z, step));
        }
    }
    handle.by = drag_->before[active_].by + by;
}

void Editor::constrain(const Vec3& direction, const std::string& name, bool plane) {
    const DragConstraint wanted{plane ? DragConstraint::Kind::plane : DragConstraint::Kind::axis, direction};
    const bool again = drag_->constraint == wanted;
    drag_->constraint = again ? DragConstraint{} : wanted;
    drag_->constraint_name = again ? "" : plane ? "in the plane across " + name : "along " + name;
}

bool Editor::drag_key(const InputEvent& event, const OrbitCamera& camera) {
    const int number = event.key;
    if (number == key_of("escape")) {
        cancel();
        return true;
    }
    if (number == key_of("enter")) {
        drag_->picked_new = true; // a drag that is confirmed is one edit
        finish();
        wish_ = EditorWish::commit;
        return true;
    }
    if (number == key_of("backspace") && !drag_->typed.empty()) {
        drag_->typed.pop_back();
    } else if (number >= 'X' && number <= 'Z') {
        Vec3 axis(0);
        axis[number - 'X'] = 1;
        const std::string name(1, static_cast<char>(number));
        if (turns_) {
            axis_.direction = axis_.direction == axis ? -camera.forward() : axis;
            drag_->constraint_name = axis_.direction == axis ? "about " + name : "";
        } else {
            constrain(axis, name, event.modifiers.shift);
        }
    } else if (number == 'N' && handles_[active_].place.normal != Vec3(0)) {
        const Vec3& normal = handles_[active_].place.normal;
        if (turns_) {
            axis_.direction = normal;
            drag_->constraint_name = "about the normal";
        } else {
            constrain(normal, "the normal", event.modifiers.shift);
        }
    } else {
        return true; // no other command in mid-drag
    }
    apply(camera, event.modifiers.control);
    return true;
}

bool Editor::type(uint32_t character) {
    const bool digit = character >= '0' && character <= '9';
    if (!digit && character != '.' && character != '-') {
        return false;
    }
    if (character == '-') { // changes the sign wherever it is typed
        drag_->typed = drag_->typed.starts_with('-') ? drag_->typed.substr(1) : "-" + drag_->typed;
    } else if (drag_->typed.size() < 24) {
        drag_->typed += static_cast<char>(character);
    }
    return true;
}

bool Editor::key(const InputEvent& event, const OrbitCamera& camera) {
    const int number = event.key;
    if (event.modifiers.control || event.modifiers.alt) {
        return false;
    }
    if (number == 'G' || number == 'R') {
        tool = number == 'G' ? Tool::move : Tool::turn;
        if (has_handles()) {
            begin(true, false, camera);
        }
    } else if (number == 'A' || number == 'P') {
        tool = number == 'A' ? Tool::anchor : Tool::pin;
    } else if (number == key_of("enter") && has_handles()) {
        wish_ = EditorWish::commit;
    } else if (number == key_of("escape") && has_handles()) {
        clear();
        wish_ = EditorWish::drop;
    } else {
        return false;
    }
    return true;
}

void Editor::finish() {
    const bool moved =
        std::abs(drag_->now.x - drag_->start.x) + std::abs(drag_->now.y - drag_->start.y) > still_pixels ||
        !drag_->typed.empty();
    // One handle that was picked and dragged in one go is a whole edit; several, or one that was set up with
    // anchors first, are taken by Enter.
    const bool whole =
        drag_->picked_new && handles_.size() == 1 && handles_[0].anchors.empty() && pins_.empty();
    if (!moved) {
        handles_ = drag_->before;
    }
    drag_.reset();
    wish_ = whole && moved ? EditorWish::commit : EditorWish::preview;
}

void Editor::cancel() {
    handles_ = drag_->before;
    const bool gone = drag_->picked_new;
    drag_.reset();
    if (gone) {
        handles_.pop_back();
        active_ = handles_.empty() ? 0 : handles_.size() - 1;
    }
    wish_ = has_handles() ? EditorWish::preview : EditorWish::drop;
}

std::string Editor::hint() const {
    if (drag_) {
        const PickedHandle& handle = handles_[active_];
        const std::string amount =
            turns_ ? rounded_text(handle.degrees) + " degrees" : "by " + rounded_text(glm::length(handle.by));
        return (turns_ ? "Turn " : "Move ") + drag_->constraint_name +
               (drag_->constraint_name.empty() ? "" : ", ") + amount +
               (drag_->typed.empty() ? "" : " (typed " + drag_->typed + ")") +
               "   X Y Z N: axis   Shift+X Y Z N: plane   wheel: radius   Ctrl: snap   Shift: precise   "
               "Enter: "
               "take   Esc: cancel";
    }
    if (has_handles()) {
        return std::to_string(handles_.size()) + (handles_.size() == 1 ? " handle" : " handles") +
               "   drag one, or G: move   R: turn   A: anchors   P: pins   Shift+click: another handle   "
               "Enter: take   Esc: drop";
    }
    return "Drag a point of the surface   Shift+click: several handles   G/R: move or turn tool   middle "
           "button or Alt: view   F1: all keys";
}

} // namespace anvil

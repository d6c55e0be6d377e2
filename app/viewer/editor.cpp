#include "app/viewer/editor.h"

#include "app/viewer/navigation.h"
#include "app/viewer/recorded_path.h"
#include "app/viewer/window.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace anvil {

namespace {

constexpr double grab_pixels = 12;
constexpr double path_tolerance = 0.005; ///< of the radius
constexpr double precise = 0.1;          ///< of a step of the wheel, with Shift

} // namespace

EditorWish Editor::take_wish() {
    return std::exchange(wish_, EditorWish::nothing);
}

void Editor::clear() {
    handles_ = {};
    pins_.clear();
    drag_.reset();
}

void Editor::surface_changed(const OrbitCamera& camera, const PickSurface* surface) {
    if (hover_) {
        hover_ = surface != nullptr ? surface->hit(camera.ray(cursor_.x, cursor_.y)) : std::nullopt;
    }
}

void Editor::settings_changed() {
    if (has_handles()) {
        wish_ = EditorWish::preview;
    }
}

Edit Editor::edit() const {
    Edit edit;
    edit.kind = handles_.turns ? EditKind::rotate : EditKind::translate;
    if (handles_.turns) {
        edit.axis = handles_.axis;
    }
    edit.radius = radius;
    edit.shape = shape;
    edit.metric = metric;
    edit.refine = refine;
    edit.mirror = mirror;
    for (const PickedHandle& picked : handles_.all) {
        Handle& handle = edit.handles.emplace_back();
        handle.at = picked.place.at;
        if (handles_.turns) {
            handle.degrees = picked.degrees;
        } else {
            handle.path = thinned_path(picked.way, path_tolerance * radius);
            handle.by = handle.path.empty() ? std::optional(picked.by) : std::nullopt;
        }
        if (picked.has_anchors()) {
            Anchors& anchors = edit.anchors.emplace_back();
            anchors.handle = static_cast<uint32_t>(edit.handles.size() - 1);
            for (const PickedPlace& place : picked.anchors) {
                anchors.at.emplace_back(place.at);
            }
            for (const PickedLine& line : picked.anchor_lines) {
                anchors.at.emplace_back(PolylineAddress{line.addresses()});
            }
            for (const PickedFace& face : picked.anchor_faces) {
                anchors.at.emplace_back(face.at);
            }
        }
    }
    for (const PickedPlace& pin : pins_) {
        edit.pinned.push_back(pin.at);
    }
    for (const PickedPlace& pin : lasting_pins_) {
        edit.pinned.push_back(pin.at);
    }
    return edit;
}

std::optional<size_t> Editor::handle_at(const OrbitCamera& camera, double x, double y) const {
    std::optional<size_t> best;
    double nearest = grab_pixels * camera.unit;
    for (size_t i = 0; i < handles_.all.size(); ++i) {
        const ScreenPoint at = camera.project(target(handles_.all[i]));
        const double away = std::hypot(at.x - x, at.y - y);
        if (at.visible() && away <= nearest) {
            nearest = away;
            best = i;
        }
    }
    return best;
}

void Editor::set_lasting_pins(std::vector<PickedPlace> pins) {
    lasting_pins_ = std::move(pins);
    settings_changed();
}

void Editor::add_line(const PickedLine& line, bool further) {
    if (further || !has_handles()) {
        handles_.all.push_back({line.points[line.points.size() / 2], Vec3(0), 0, {}, {}, {}});
        handles_.active = handles_.all.size() - 1;
    }
    handles_.all[handles_.active].anchor_lines.push_back(line);
    settings_changed();
}

void Editor::set_path(const std::vector<SurfaceAddress>& points, const std::vector<Vec3>& path) {
    for (PickedHandle& handle : handles_.all) {
        for (PickedLine& line : handle.anchor_lines) {
            if (line.addresses() == points) {
                line.path = path;
            }
        }
    }
}

void Editor::add_anchors(const std::vector<PickedFace>& faces, const std::vector<PickedPlace>& places) {
    PickedHandle& handle = handles_.all[handles_.active];
    handle.anchor_faces.insert(handle.anchor_faces.end(), faces.begin(), faces.end());
    handle.anchors.insert(handle.anchors.end(), places.begin(), places.end());
    settings_changed();
}

void Editor::pick(const SurfaceHit& hit, bool further) {
    const PickedPlace place = place_of(hit);
    if (tool == Tool::pin) {
        pins_.push_back(place);
    } else if (tool == Tool::anchor && has_handles()) {
        handles_.all[handles_.active].anchors.push_back(place);
    } else {
        if (!further) {
            clear();
        }
        handles_.all.push_back({place, Vec3(0), 0, {}, {}, {}});
        handles_.active = handles_.all.size() - 1;
        handles_.turns = tool == Tool::turn;
    }
    settings_changed();
}

bool Editor::handle(const InputEvent& event, const OrbitCamera& camera, const PickSurface* surface) {
    snapping_ = event.kind == InputEvent::Kind::text ? snapping_ : event.modifiers.control;
    switch (event.kind) {
    case InputEvent::Kind::move:
        cursor_ = {event.x, event.y};
        if (drag_) {
            drag_->move(event, camera, handles_);
            apply(camera, event.modifiers.control);
            return true;
        }
        hover_ = surface != nullptr ? surface->hit(camera.ray(event.x, event.y)) : std::nullopt;
        return false;
    case InputEvent::Kind::press:
        return press(event, camera, surface);
    case InputEvent::Kind::release:
        if (drag_ && !drag_->modal() && event.button == MouseButton::left) {
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
        if (drag_ && drag_->type(event.character)) {
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
        if (drag_->modal() && event.button == MouseButton::left) {
            finish();
        } else if (event.button == MouseButton::right) {
            cancel();
        }
        return true;
    }
    if (event.button != MouseButton::left || event.modifiers.alt || tool == Tool::line ||
        tool == Tool::select) {
        return false;
    }
    const auto grabbed = handle_at(camera, cursor_.x, cursor_.y);
    const bool grabs = tool == Tool::move || tool == Tool::turn;
    if (grabbed && grabs) {
        handles_.active = *grabbed;
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
    handles_.turns = tool == Tool::turn;
    drag_.emplace(handles_, camera, cursor_, modal, picked_new);
    if (mirror && handles_.turns) { // the one axis that both sides can turn about wherever they are
        handles_.axis.direction = Vec3(0);
        handles_.axis.direction[mirror->axis] = 1;
    }
    settings_changed();
}

void Editor::apply(const OrbitCamera& camera, bool snap) {
    drag_->apply(camera, radius, snap, handles_);
    note_way();
    wish_ = EditorWish::preview;
}

/// What is typed has the straight way from the drag's start.
void Editor::note_way() {
    PickedHandle& handle = handles_.all[handles_.active];
    const PickedHandle& before = drag_->before()[handles_.active];
    if (!follow_path || handles_.turns) {
        handle.way.clear();
        return;
    }
    if (handle.way.empty()) {
        handle.way.push_back(before.by);
    }
    if (drag_->typed()) {
        handle.way.resize(std::max<size_t>(before.way.size(), 1));
    }
    handle.way.push_back(handle.by);
}

bool Editor::drag_key(const InputEvent& event, const OrbitCamera& camera) {
    if (event.key == key_of("escape")) {
        cancel();
    } else if (event.key == key_of("enter")) {
        finish(); // a drag that is confirmed is one edit
        wish_ = EditorWish::commit;
    } else if (drag_->key(event, camera, handles_)) {
        apply(camera, event.modifiers.control);
    }
    return true; // no other command in mid-drag
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
    // One handle that was picked and dragged in one go is a whole edit; several, or one that was set up with
    // anchors first, are taken by Enter.
    const bool whole =
        drag_->picked_new() && handles_.all.size() == 1 && !handles_.all[0].has_anchors() && pins_.empty();
    // A path may end where it began.
    const bool moved = drag_->moved() || (follow_path && !handles_.turns && drag_->went());
    if (!moved) {
        handles_.all = drag_->before();
    }
    drag_.reset();
    wish_ = whole && moved ? EditorWish::commit : EditorWish::preview;
}

void Editor::cancel() {
    handles_.all = drag_->before();
    if (drag_->picked_new()) {
        handles_.all.pop_back();
        handles_.active = handles_.all.empty() ? 0 : handles_.all.size() - 1;
    }
    drag_.reset();
    wish_ = has_handles() ? EditorWish::preview : EditorWish::drop;
}

std::string Editor::hint() const {
    if (drag_) {
        return drag_->description(handles_) +
               "   X Y Z N: axis   Shift+X Y Z N: plane   wheel: radius   Ctrl: snap   Shift: precise   "
               "Enter: take   Esc: cancel";
    }
    if (tool == Tool::line) {
        return "Click the points of a line along the surface   Enter, or the last point again: end it   "
               "first "
               "point: close it   Shift+Enter: another handle   Backspace: a point less   Esc: drop it";
    }
    if (tool == Tool::select) {
        return "Drag a box (B) or a lasso (Shift+B)   Shift: add   Ctrl: take away   V: through the surface  "
               " + - "
               "H Ctrl+I: grow, shrink, hide, invert   Ctrl+P: pin   Shift+A: anchors   G: move";
    }
    if (has_handles()) {
        const size_t count = handles_.all.size();
        return std::to_string(count) + (count == 1 ? " handle" : " handles") +
               "   drag one, or G: move   R: turn   A: anchors   P: pins   Shift+click: another handle   "
               "Enter: take   Esc: drop";
    }
    return "Drag a point of the surface   Shift+click: several handles   G/R: move or turn tool   middle "
           "button or Alt: view   F1: all keys";
}

} // namespace anvil

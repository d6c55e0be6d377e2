#include "app/viewer/line_tool.h"

#include "app/viewer/window.h"

#include <cmath>
#include <utility>

namespace anvil {

namespace {

constexpr double same_pixels = 6; ///< a click that near to a point means that point

bool is_at(const Cursor& cursor, const PickedPlace& place, const OrbitCamera& camera) {
    const ScreenPoint at = camera.project(place.position);
    return at.visible() && std::hypot(at.x - cursor.x, at.y - cursor.y) <= same_pixels;
}

} // namespace

bool LineTool::handle(const InputEvent& event, const OrbitCamera& camera, const PickSurface* surface) {
    switch (event.kind) {
    case InputEvent::Kind::move:
        cursor_ = {event.x, event.y};
        return false;
    case InputEvent::Kind::press:
        return press(event, camera, surface);
    case InputEvent::Kind::key_down:
        return !line_.points.empty() && key(event);
    default:
        return false;
    }
}

bool LineTool::press(const InputEvent& event, const OrbitCamera& camera, const PickSurface* surface) {
    if (event.button != MouseButton::left || event.modifiers.alt) {
        return false;
    }
    std::vector<PickedPlace>& points = line_.points;
    if (points.size() >= 2 && is_at(cursor_, points.back(), camera)) {
        finish(event.modifiers.shift);
        return true;
    }
    if (points.size() >= 3 && is_at(cursor_, points.front(), camera)) {
        points.push_back(points.front());
        finish(event.modifiers.shift);
        return true;
    }
    const auto hit = surface != nullptr ? surface->hit(camera.ray(cursor_.x, cursor_.y)) : std::nullopt;
    if (hit) {
        points.push_back(place_of(*hit));
    }
    return hit.has_value();
}

bool LineTool::key(const InputEvent& event) {
    if (event.key == key_of("enter")) {
        if (line_.points.size() >= 2) {
            finish(event.modifiers.shift);
        }
    } else if (event.key == key_of("backspace")) {
        line_.points.pop_back();
    } else if (event.key == key_of("escape")) {
        line_ = {};
    } else {
        return false;
    }
    return true;
}

void LineTool::finish(bool further) {
    finished_ = Finished{std::exchange(line_, {}), further};
}

std::optional<LineTool::Finished> LineTool::take() {
    return std::exchange(finished_, std::nullopt);
}

void LineTool::set_path(const std::vector<SurfaceAddress>& points, const std::vector<Vec3>& path) {
    if (line_.addresses() == points) {
        line_.path = path;
    }
}

void LineTool::surface_changed(const PickSurface* surface) {
    line_.path.clear();
    for (PickedPlace& place : line_.points) {
        const auto now = surface != nullptr ? surface->position(place.at) : std::nullopt;
        if (!now) {
            line_ = {};
            return;
        }
        place.position = *now;
    }
}

} // namespace anvil

#include "app/viewer/gizmo.h"

#include <algorithm>
#include <numbers>

namespace anvil {

namespace {

// Pixels from the centre, on a display of 96 dots an inch.
constexpr double free_radius = 9;
constexpr double arrow_begin = 16;
constexpr double arrow_end = 78;
constexpr double face_near = 26;
constexpr double face_far = 42;
constexpr double ring_radius = 96;
constexpr double view_ring = 118;
constexpr double scale_half = 6;
constexpr double grab = 6;
constexpr double shortest = 12; ///< an arrow that looks shorter points at the eye
constexpr int ring_parts = 64;

/// Window places around one centre.
class Sketch {
  public:
    Sketch(const OrbitCamera& camera, const Vec3& centre)
        : camera_(camera), centre_(centre), middle_(camera.project(centre)),
          pixel_(camera.unit * camera.pixel_size(middle_.depth)) {}

    bool visible() const { return middle_.visible(); }
    glm::dvec2 middle() const { return {middle_.x, middle_.y}; }

    /// So many pixels away, seen across the view.
    glm::dvec2 at(const Vec3& offset) const {
        const ScreenPoint place = camera_.project(centre_ + pixel_ * offset);
        return {place.x, place.y};
    }
    bool in_front(const Vec3& offset) const { return glm::dot(offset, camera_.forward()) <= 1e-9; }

  private:
    const OrbitCamera& camera_;
    Vec3 centre_;
    ScreenPoint middle_;
    double pixel_;
};

Vec3 along(int axis, double length) {
    Vec3 offset(0);
    offset[axis] = length;
    return offset;
}

std::vector<glm::dvec2> circle(const glm::dvec2& middle, double radius) {
    std::vector<glm::dvec2> line;
    for (int i = 0; i <= ring_parts; ++i) {
        const double angle = 2 * std::numbers::pi * i / ring_parts;
        line.push_back(middle + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return line;
}

/// The front half of a ring; all of it where it faces the eye.
GizmoMark ring(const Sketch& sketch, int axis) {
    GizmoMark mark{{GizmoAction::turn, axis}, {}, false};
    std::array<bool, ring_parts> front{};
    std::array<Vec3, ring_parts> places;
    for (int i = 0; i < ring_parts; ++i) {
        const double angle = 2 * std::numbers::pi * i / ring_parts;
        Vec3 place(0);
        place[(axis + 1) % 3] = ring_radius * std::cos(angle);
        place[(axis + 2) % 3] = ring_radius * std::sin(angle);
        places[static_cast<size_t>(i)] = place;
        front[static_cast<size_t>(i)] = sketch.in_front(place);
    }
    size_t first = 0; // of the front half
    while (first < ring_parts && !(front[first] && !front[(first + ring_parts - 1) % ring_parts])) {
        ++first;
    }
    const bool whole = first == ring_parts;
    for (size_t i = 0; i <= ring_parts; ++i) {
        const size_t at = (first + i) % ring_parts;
        if (!whole && !front[at]) {
            break;
        }
        mark.line.push_back(sketch.at(places[at]));
    }
    return mark;
}

double apart(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 way = b - a;
    const double length = glm::dot(way, way);
    const double s = length > 0 ? std::clamp(glm::dot(p - a, way) / length, 0.0, 1.0) : 0;
    return glm::length(p - a - s * way);
}

double apart(const glm::dvec2& p, const std::vector<glm::dvec2>& line) {
    double least = infinity;
    for (size_t i = 1; i < line.size(); ++i) {
        least = std::min(least, apart(p, line[i - 1], line[i]));
    }
    return least;
}

/// By how often a ray to the right crosses the outline.
bool inside(const glm::dvec2& p, const std::vector<glm::dvec2>& outline) {
    bool odd = false;
    for (size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2& a = outline[i];
        const glm::dvec2& b = outline[(i + 1) % outline.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
            odd = !odd;
        }
    }
    return odd;
}

} // namespace

std::vector<GizmoMark> gizmo_marks(const OrbitCamera& camera, const Vec3& centre) {
    const Sketch sketch(camera, centre);
    std::vector<GizmoMark> marks;
    if (!sketch.visible()) {
        return marks;
    }
    const glm::dvec2 middle = sketch.middle();
    marks.push_back({{GizmoAction::turn_in_view, 0}, circle(middle, camera.unit * view_ring), false});
    for (int axis = 0; axis < 3; ++axis) {
        marks.push_back(ring(sketch, axis));
    }
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        const std::vector<glm::dvec2> face{sketch.at(along(u, face_near) + along(v, face_near)),
                                           sketch.at(along(u, face_far) + along(v, face_near)),
                                           sketch.at(along(u, face_far) + along(v, face_far)),
                                           sketch.at(along(u, face_near) + along(v, face_far))};
        if (std::abs(camera.forward()[axis]) > 0.2) {
            marks.push_back({{GizmoAction::across, axis}, face, true});
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec2 tip = sketch.at(along(axis, arrow_end));
        if (glm::length(tip - middle) > camera.unit * shortest) {
            marks.push_back({{GizmoAction::move, axis}, {sketch.at(along(axis, arrow_begin)), tip}, false});
        }
    }
    const glm::dvec2 corner = middle + camera.unit * view_ring * std::numbers::sqrt2 / 2 * glm::dvec2(1, -1);
    const double half = camera.unit * scale_half;
    marks.push_back({{GizmoAction::scale, 0},
                     {corner + half * glm::dvec2(-1, -1), corner + half * glm::dvec2(1, -1),
                      corner + half * glm::dvec2(1, 1), corner + half * glm::dvec2(-1, 1)},
                     true});
    marks.push_back({{GizmoAction::move_freely, 0}, circle(middle, camera.unit * free_radius), true});
    return marks;
}

GizmoPart gizmo_part_at(const std::vector<GizmoMark>& marks, double x, double y) {
    const glm::dvec2 place(x, y);
    for (auto mark = marks.rbegin(); mark != marks.rend(); ++mark) {
        if (mark->filled && inside(place, mark->line)) {
            return mark->part;
        }
    }
    GizmoPart nearest;
    double least = grab;
    for (const GizmoMark& mark : marks) {
        const double away = mark.filled ? infinity : apart(place, mark.line);
        if (away <= least) { // of equally near ones that on top
            least = away;
            nearest = mark.part;
        }
    }
    return nearest;
}

} // namespace anvil

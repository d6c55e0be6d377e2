#include "app/viewer/drag_motion.h"

namespace anvil {

namespace {

/// Where the ray meets the plane through `point`; nothing if it runs along it or away from it.
std::optional<Vec3> on_plane(const Ray& ray, const Vec3& point, const Vec3& normal) {
    const double slope = glm::dot(ray.direction, normal);
    if (std::abs(slope) < 0.02) { // a pixel would be fifty times as long as it looks
        return std::nullopt;
    }
    const double distance = glm::dot(point - ray.origin, normal) / slope;
    return distance > 0 ? std::optional(ray.origin + distance * ray.direction) : std::nullopt;
}

Vec3 in_view(const OrbitCamera& camera, const Vec3& start, const Cursor& from, const Cursor& to) {
    const auto a = on_plane(camera.ray(from.x, from.y), start, camera.forward());
    const auto b = on_plane(camera.ray(to.x, to.y), start, camera.forward());
    return a && b ? *b - *a : Vec3(0);
}

/// How far along the axis through `start` the ray comes nearest to it; nothing where it runs along it.
std::optional<double> along_axis(const Ray& ray, const Vec3& start, const Vec3& axis) {
    const double across = glm::dot(ray.direction, axis);
    const double spread = 1 - across * across;
    if (spread < 4e-4) {
        return std::nullopt;
    }
    const Vec3 arm = start - ray.origin;
    return (across * glm::dot(arm, ray.direction) - glm::dot(arm, axis)) / spread;
}

} // namespace

Vec3 dragged(const OrbitCamera& camera, const Vec3& start, const Cursor& from, const Cursor& to,
             const DragConstraint& constraint) {
    const Vec3 free = in_view(camera, start, from, to);
    if (constraint.kind == DragConstraint::Kind::view) {
        return free;
    }
    const Vec3 direction = glm::normalize(constraint.direction);
    const Ray first = camera.ray(from.x, from.y);
    const Ray last = camera.ray(to.x, to.y);
    if (constraint.kind == DragConstraint::Kind::axis) {
        const auto a = along_axis(first, start, direction);
        const auto b = along_axis(last, start, direction);
        return (a && b ? *b - *a : glm::dot(free, direction)) * direction;
    }
    const auto a = on_plane(first, start, direction);
    const auto b = on_plane(last, start, direction);
    return a && b ? *b - *a : free - glm::dot(free, direction) * direction;
}

double turned(const OrbitCamera& camera, const Vec3& centre, const Vec3& axis, const Cursor& from,
              const Cursor& to) {
    const ScreenPoint middle = camera.project(centre);
    const glm::dvec2 a(from.x - middle.x, middle.y - from.y); // y up
    const glm::dvec2 b(to.x - middle.x, middle.y - to.y);
    if (glm::length(a) < 2 || glm::length(b) < 2) {
        return 0;
    }
    const double angle = std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
    const double towards_eye = glm::dot(axis, camera.forward()) <= 0 ? 1 : -1;
    return glm::degrees(angle) * towards_eye;
}

double to_multiple(double value, double step) {
    return std::round(value / step) * step;
}

double round_step(double size) {
    if (!(size > 0) || !std::isfinite(size)) {
        return 1;
    }
    const double hundredth = size / 100;
    const double power = std::pow(10, std::floor(std::log10(hundredth)));
    const double digit = hundredth / power;
    return power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
}

} // namespace anvil

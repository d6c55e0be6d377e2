#include "engine/edit/rotation.h"

#include <numbers>

namespace anvil {

namespace {

// By the largest component first: lengths beyond 1e154 or below 1e-154 have squares that double cannot hold.
Vec3 unit(const Vec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0 ? glm::normalize(v / largest) : Vec3(0.0);
}

Vec3 perpendicular_part(const Vec3& v, const Vec3& axis) {
    return v - glm::dot(v, axis) * axis;
}

} // namespace

Rotation::Rotation(const Vec3& through, const Vec3& along) : origin(through), direction(unit(along)) {}

Vec3 Rotation::turned(const Vec3& p, double angle) const {
    const Vec3 arm = p - origin;
    const Vec3 across = glm::cross(direction, arm);
    const double half_sine = std::sin(0.5 * angle);
    return p + std::sin(angle) * across + 2 * half_sine * half_sine * glm::cross(direction, across);
}

double Rotation::angle_to_reach(const Vec3& p, const Vec3& target) const {
    const Vec3 from = unit(perpendicular_part(p - origin, direction));
    const Vec3 to = unit(perpendicular_part(target - origin, direction));
    if (from == Vec3(0.0) || to == Vec3(0.0)) {
        return 0;
    }
    const double angle = std::atan2(glm::dot(direction, glm::cross(from, to)), glm::dot(from, to));
    return angle <= -std::numbers::pi ? std::numbers::pi : angle;
}

} // namespace anvil

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

double radians(double degrees) {
    return degrees * (std::numbers::pi / 180);
}

Vec3 rotated(const Vec3& p, const Vec3& origin, const Vec3& direction, double degrees) {
    const Vec3 axis = unit(direction);
    const Vec3 arm = p - origin;
    const double angle = radians(degrees);
    const double half_sine = std::sin(0.5 * angle);
    const Vec3 across = glm::cross(axis, arm);
    // Increments on p: small angles and points on the axis keep all digits.
    return p + std::sin(angle) * across + 2 * half_sine * half_sine * glm::cross(axis, across);
}

double angle_to_reach(const Vec3& p, const Vec3& origin, const Vec3& direction, const Vec3& target) {
    const Vec3 axis = unit(direction);
    const Vec3 from = unit(perpendicular_part(p - origin, axis));
    const Vec3 to = unit(perpendicular_part(target - origin, axis));
    if (from == Vec3(0.0) || to == Vec3(0.0)) {
        return 0;
    }
    const double sine = glm::dot(axis, glm::cross(from, to));
    const double degrees = std::atan2(sine, glm::dot(from, to)) * (180 / std::numbers::pi);
    return degrees <= -180 ? 180 : degrees;
}

} // namespace anvil

// Angles of triangles in space.
#pragma once

#include "engine/core/types.h"

#include <algorithm>

namespace anvil {

/// The angle at a, in radians; atan2 keeps its digits near 0, where acos has none.
inline double angle_at(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::atan2(glm::length(glm::cross(b - a, c - a)), glm::dot(b - a, c - a));
}

inline double least_angle_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::min({angle_at(a, b, c), angle_at(b, c, a), angle_at(c, a, b)});
}

} // namespace anvil

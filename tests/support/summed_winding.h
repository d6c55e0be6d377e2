// The winding number without anything of the engine's: what its signs are held against.
#pragma once

#include "engine/mesh/mesh.h"

#include <cmath>
#include <numbers>

namespace anvil {

/// Summed over all triangles: Van Oosterom and Strackee's solid angle, over 4 pi.
inline double winding(const Mesh& mesh, const Vec3& p) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.positions[t[0]] - p;
        const Vec3 b = mesh.positions[t[1]] - p;
        const Vec3 c = mesh.positions[t[2]] - p;
        const double x = glm::length(a);
        const double y = glm::length(b);
        const double z = glm::length(c);
        sum += std::atan2(glm::dot(a, glm::cross(b, c)),
                          x * y * z + glm::dot(a, b) * z + glm::dot(b, c) * x + glm::dot(c, a) * y);
    }
    return sum / (2 * std::numbers::pi);
}

} // namespace anvil

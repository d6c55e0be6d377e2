// What benchmarks of occluders share: meshes by name, and winding numbers without any of the engine's own.
#pragma once

#include "engine/core/log.h"
#include "engine/mesh/mesh_reader.h"
#include "engine/mesh/sample_shapes.h"

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

namespace anvil::bench {

/// A file, or SAMPLE:VERTICES.
inline Mesh mesh_named(const std::string& name) {
    const size_t colon = name.rfind(':');
    if (colon != std::string::npos) {
        return make_sample(name.substr(0, colon), std::strtoul(name.c_str() + colon + 1, nullptr, 10));
    }
    Log log;
    return read_mesh(name, log);
}

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

} // namespace anvil::bench

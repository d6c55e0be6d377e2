// From bare triangles to the mesh structure.
#pragma once

#include "engine/mesh/mesh.h"

#include <utility>

namespace anvil {

/// Mesh whose polygons are exactly `triangles`, in their order.
inline Mesh mesh_of_triangles(std::vector<Vec3> positions, std::vector<Triangle> triangles) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    mesh.corners.reserve(3 * triangles.size());
    mesh.polygon_begin.reserve(triangles.size() + 1);
    for (const Triangle& triangle : triangles) {
        mesh.add_polygon(triangle);
    }
    mesh.triangles = std::move(triangles);
    return mesh;
}

} // namespace anvil

// Vertices and triangles numbered anew, so that what is close on the surface is close in memory.
#pragma once

#include "engine/core/types.h"

#include <span>
#include <vector>

namespace anvil {

struct Numbering {
    std::vector<uint32_t> mesh_vertex;  ///< of each vertex in the new order
    std::vector<uint32_t> new_vertex;   ///< of each vertex of the mesh
    std::vector<uint32_t> new_triangle; ///< of each triangle of the mesh
};

/// Vertices by order_by_place(), triangles by their first vertex in that order. Meshes
/// as files have them jump about: marching over them waits for memory more than half of its time.
Numbering number_by_place(std::span<const Triangle> triangles, std::span<const Vec3> positions);

/// Everything keeps its number.
Numbering number_as_given(size_t triangles, size_t vertices);

} // namespace anvil

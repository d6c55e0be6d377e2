// The file's own normals after an edit.
#pragma once

#include "engine/mesh/mesh.h"

#include <span>
#include <vector>

namespace anvil {

/// Whether the file gave normals: vertex columns nx, ny, nz, or corner_normals.
bool has_normals(const Mesh& mesh);

/// Turns the normals that the file gave at every vertex that
/// moved or shares a polygon with one that did, by the shortest rotation that takes the geometric vertex
/// normal of mesh.positions to that of `new_positions`; lengths and deviations from the geometric normal
/// (creases) are kept. All others stay bit-identical: a pool entry shared with an unmoved corner is copied
/// first. mesh.positions are not changed. @pre both arguments have n entries.
void update_normals(Mesh& mesh, std::span<const Vec3> new_positions, const std::vector<bool>& moved);

} // namespace anvil

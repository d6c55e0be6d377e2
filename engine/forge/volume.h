// The volume that a surface encloses.
#pragma once

#include "engine/mesh/mesh.h"

#include <span>

namespace anvil {

/// Whether every triangle edge is met as often in one direction as in the other. O(triangles), no tables.
bool is_closed(const Mesh& mesh);

/// Signed volume (world units cubed) that a closed mesh encloses with its vertices at `positions`; negative
/// if its faces look inwards.
double enclosed_volume(const Mesh& mesh, std::span<const Vec3> positions);

} // namespace anvil

// A smoothed copy of a surface: distances on it do not run up and down small bumps.
#pragma once

#include "engine/mesh/mesh.h"

#include <span>

namespace anvil {

/// Positions without bumps up to some `rounds` / 4 edges across; what is larger keeps its size. A polynomial
/// of degree `rounds` in the averaging of neighbours that keeps low frequencies (Chebyshev with Jackson's
/// damping), of which only the part along the smooth surface's normals is taken, so that vertices do not
/// slide and flat parts stay as they are. Vertices at the boundary, at edges with more than two triangles and
/// without any triangle stay. 0 rounds give the positions. O(triangles rounds), on all cores.
std::vector<Vec3> smoothed_positions(const Mesh& mesh, std::span<const Vec3> positions, uint32_t rounds);

} // namespace anvil

// The slope of a distance field in each triangle.
#pragma once

#include "engine/core/types.h"

#include <span>
#include <vector>

namespace anvil {

/// Gradient of the linear interpolation of `values` (one per position) in each triangle, in its plane; its
/// length is near 1 for a distance field. 0 where a corner is not finite or the triangle has no area.
std::vector<Vec3> face_gradients(std::span<const Triangle> triangles, std::span<const Vec3> positions,
                                 std::span<const double> values);

} // namespace anvil

// Less detail from the same vertices.
#pragma once

#include "engine/core/types.h"

#include <span>
#include <vector>

namespace anvil {

/// Corners of about `count` triangles (half to twice as many on surfaces that are much larger than their
/// triangles) that look like these from afar: vertices within one cube of a grid become the one among them
/// that is nearest to their middle. No triangle comes twice or lost its area by having a corner twice. Places
/// that are not finite, and their triangles, are left out. O(n + t), the same for the same input.
std::vector<uint32_t> coarse_triangles(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                       size_t count);

} // namespace anvil

// Which triangles of a surface pass through each other.
#pragma once

#include "engine/core/types.h"
#include "engine/mesh/search_tree.h"

#include <span>
#include <vector>

namespace anvil {

enum class Crossing : uint8_t {
    none,
    unsure, ///< it touches, overlaps or comes too near to another for rounding to tell
    crosses
};

/// For each triangle whether it meets another one elsewhere than in their common corners (equal indices) and
/// edges. `tree`: of these triangles. All cores; about linear time for ordinary meshes.
std::vector<Crossing> find_crossings(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                     const SearchTree& tree);

} // namespace anvil

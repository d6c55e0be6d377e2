// Equal positions found in linear time.
#pragma once

#include "engine/core/types.h"

#include <span>
#include <vector>

namespace anvil {

/// For each position the lowest index that has exactly the same one (-0 equals 0). Finite positions,
/// fewer than 2^31 of them.
std::vector<uint32_t> first_equal(std::span<const Vec3> positions);

} // namespace anvil

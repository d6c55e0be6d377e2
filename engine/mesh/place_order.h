// Orders in which what is close in space is close in the list.
#pragma once

#include "engine/core/types.h"

#include <span>
#include <vector>

namespace anvil {

/// The indices of points, all finite, along a curve that fills space (Morton's): neighbours in the list are
/// mostly close.
std::vector<uint32_t> order_by_place(std::span<const Vec3> points);

/// `items` in the order of their keys (keys[item] >> shift) & mask, equal ones as before.
std::vector<uint32_t> sorted_by(const std::vector<uint32_t>& items, const std::vector<uint32_t>& keys,
                                int shift, uint32_t mask);

} // namespace anvil

// A handle's path from places that a person dragged it through.
#pragma once

#include "engine/core/types.h"

#include <span>
#include <vector>

namespace anvil {

/// As few of the offsets as keep every other one within `tolerance` of the lines between them; the first and
/// the last stay, also where both are one place. Empty where they never leave the first one.
std::vector<Vec3> thinned_path(std::span<const Vec3> offsets, double tolerance);

} // namespace anvil

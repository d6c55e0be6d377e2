// The mirror plane of the edit under way.
#pragma once

#include "engine/core/types.h"
#include "engine/edit/recipe.h"

namespace anvil {

/// Off, or the axis that the plane stands upright on and where. Whether something was changed.
bool mirror_controls(std::optional<Mirror>& mirror, const Box& scene);

} // namespace anvil

// A hammer's motion from poses that a person dragged it through.
#pragma once

#include "engine/edit/recipe.h"

#include <span>
#include <vector>

namespace anvil {

/// The way from one pose to the next, its turn and growth as what they move at `size` from the middle.
double way_between(const Transform& a, const Transform& b, double size);

/// The poses' motion, at equal speed: as few of them as bring each within `tolerance` (a length, turns and
/// growth counted as in way_between()) of where it was. Keys that no pose changes are left out but for the
/// place. Empty where the poses never leave the first one.
std::vector<MotionPose> recorded_motion(std::span<const Transform> poses, double size, double tolerance);

} // namespace anvil

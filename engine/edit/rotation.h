// Rotations about an axis in space: right-handed, angles in degrees, never wrapped.
#pragma once

#include "engine/core/types.h"

namespace anvil {

double radians(double degrees);

/// `p` turned about the line through `origin` along `direction` (not zero, need not be unit).
Vec3 rotated(const Vec3& p, const Vec3& origin, const Vec3& direction, double degrees);

/// The angle in (-180, 180] that brings `p`, turned about the axis, nearest to `target`. 0 where every angle
/// is as good: `p` or `target` on the axis.
double angle_to_reach(const Vec3& p, const Vec3& origin, const Vec3& direction, const Vec3& target);

} // namespace anvil

// Rotations about an axis in space: right-handed, angles in radians, never wrapped.
#pragma once

#include "engine/core/types.h"

namespace anvil {

/// Rotation about the line through `origin` along `direction`, eq. 6 of Bendels & Klein 2003.
struct Rotation {
    /// `along`: not zero, need not be unit.
    Rotation(const Vec3& through, const Vec3& along);

    /// `p` turned by `angle`; small angles and points on the axis keep all digits.
    Vec3 turned(const Vec3& p, double angle) const;

    /// The angle in (-pi, pi] that brings `p` nearest to `target`. 0 where every angle is as good: `p` or
    /// `target` on the axis.
    double angle_to_reach(const Vec3& p, const Vec3& target) const;

    Vec3 origin;
    Vec3 direction; ///< unit
};

} // namespace anvil

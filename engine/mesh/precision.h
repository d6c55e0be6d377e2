// When single precision is enough for a file.
#pragma once

#include "engine/core/types.h"

#include <span>

namespace anvil {

/// Fraction of the diagonal that rounding to float may cost.
inline constexpr double float_loss_limit = 1e-8;

/// Largest change of a coordinate when rounded to float; +inf beyond float's range.
inline double float_loss(std::span<const Vec3> positions) {
    double loss = 0;
    for (const Vec3& p : positions) {
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(p[axis]) > double{std::numeric_limits<float>::max()}) {
                return infinity;
            }
            loss = std::max(loss, std::abs(p[axis] - double{static_cast<float>(p[axis])}));
        }
    }
    return loss;
}

} // namespace anvil

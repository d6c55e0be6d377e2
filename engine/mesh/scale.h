// Scaling by powers of two, so that squares of tiny and huge coordinates neither underflow nor overflow.
#pragma once

#include "engine/core/types.h"

namespace anvil {

/// The power of two that brings the length into [0.5, 1); 1 for 0 and for non-finite lengths. Multiplying by
/// it is exact, so that a mesh scaled by a power of two gives the same result bit for bit.
inline double unit_scale(double length) {
    if (!(length > 0) || !std::isfinite(length)) {
        return 1;
    }
    int exponent = 0;
    std::frexp(length, &exponent);
    return std::ldexp(1.0, std::clamp(-exponent, -1022, 1022));
}

} // namespace anvil

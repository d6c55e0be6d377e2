// Small types that every room shares.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace anvil {

using Vec3 = glm::dvec3;                  ///< a point or direction, double
using Triangle = std::array<uint32_t, 3>; ///< three vertex indices, counterclockwise from outside

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr uint32_t no_index = std::numeric_limits<uint32_t>::max();

inline bool is_finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Axis-aligned box; empty while low > high.
struct Box {
    Vec3 low{infinity};
    Vec3 high{-infinity};

    void include(const Vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    bool empty() const { return low.x > high.x; }
    Vec3 centre() const { return 0.5 * low + 0.5 * high; }
    /// Length of the diagonal; 0 when empty. Does not overflow where the extent itself is finite.
    double diagonal() const {
        if (empty()) {
            return 0;
        }
        const Vec3 extent = high - low;
        const double longest = std::max({extent.x, extent.y, extent.z});
        return longest > 0 && std::isfinite(longest) ? longest * glm::length(extent / longest) : longest;
    }
};

} // namespace anvil

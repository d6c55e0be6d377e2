// Distances to triangles in single precision, four at once, with a bound on how far they are off: what
// decides which triangles are worth a look in double precision. Internal to engine/mesh.
#pragma once

#include "engine/core/types.h"

#include <array>
#include <cmath>

namespace anvil {

/// What processors add and multiply at once.
using Float4 = float __attribute__((vector_size(16)));

using Int4 = int __attribute__((vector_size(16)));

inline Float4 four(float x) {
    return Float4{x, x, x, x};
}

inline Float4 least(const Float4& a, const Float4& b) {
#ifdef __SSE__
    return __builtin_ia32_minps(a, b);
#else
    return a < b ? a : b;
#endif
}

/// Bit i: whether number i is negative.
inline unsigned signs(const Int4& x) {
#ifdef __SSE__
    return static_cast<unsigned>(__builtin_ia32_movmskps(reinterpret_cast<const Float4&>(x)));
#else
    return (x[0] < 0 ? 1U : 0U) | (x[1] < 0 ? 2U : 0U) | (x[2] < 0 ? 4U : 0U) | (x[3] < 0 ? 8U : 0U);
#endif
}

inline Float4 square_root(const Float4& x) {
#ifdef __SSE__
    return __builtin_ia32_sqrtps(x);
#else
    return Float4{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
#endif
}

inline Float4 absolute(const Float4& x) {
    return x < Float4{} ? -x : x;
}

inline Float4 most(const Float4& a, const Float4& b) {
#ifdef __SSE__
    return __builtin_ia32_maxps(a, b);
#else
    return a > b ? a : b;
#endif
}

inline Float4 clamped(const Float4& x, const Float4& high) {
    return least(most(x, Float4{}), high);
}

/// A triangle in its own plane, its longest side from the origin along the x axis: corners 0, (b, 0) and c,
/// c.y > 0. Needles, whose inside floats cannot tell, are flattened to their longest side.
struct FlatTriangle {
    glm::vec3 x_axis{0};
    glm::vec3 y_axis{0};
    float b = 0;
    glm::vec2 c{0};
    float ac2_inverse = 0; ///< of squared lengths; 0 for none
    float bc2_inverse = 0;
    float slack = 0;     ///< farthest that a point of the triangle is from what stands here
    uint32_t origin = 0; ///< which corner
};

/// `scale` makes lengths from it that floats can square.
FlatTriangle flattened(const std::array<Vec3, 3>& corners, double scale);

/// What squared_distance() may be off where no length at work exceeds R, as a share of R^2: rounded inputs
/// and three scalar products make at most 70 units of 2^-24, and a point beyond a corner as sharp as
/// flattened() leaves any, taken for one inside, 97.
inline constexpr float flat_rounding = 256 * 0x1p-24F;

/// Four flat triangles.
struct FlatFour {
    std::array<Float4, 3> x_axis;
    std::array<Float4, 3> y_axis;
    Float4 b, cx, cy, ac2_inverse, bc2_inverse, slack;

    void set(size_t lane, const FlatTriangle& triangle);
};

/// Squared distances of points, given from the triangles' origins: those of the origins, and what the nearest
/// features are nearer.
inline Float4 squared_distance(const FlatFour& t, const std::array<Float4, 3>& from_origin) {
    const auto& [wx, wy, wz] = from_origin;
    const Float4 x = t.x_axis[0] * wx + t.x_axis[1] * wy + t.x_axis[2] * wz;
    const Float4 y = t.y_axis[0] * wx + t.y_axis[1] * wy + t.y_axis[2] * wz;
    const Float4 on_ab = clamped(x, t.b);
    const Float4 by_ab = on_ab * (on_ab - 2 * x);
    const Float4 ac = t.cx * x + t.cy * y;
    const Float4 on_ac = clamped(ac * t.ac2_inverse, four(1));
    const Float4 by_ac = on_ac * (on_ac * (t.cx * t.cx + t.cy * t.cy) - 2 * ac);
    const Float4 ex = t.cx - t.b;
    const Float4 fx = x - t.b;
    const Float4 bc = ex * fx + t.cy * y;
    const Float4 on_bc = clamped(bc * t.bc2_inverse, four(1));
    const Float4 by_bc = on_bc * (on_bc * (ex * ex + t.cy * t.cy) - 2 * bc) + t.b * (t.b - 2 * x);
    const Float4 by_sides = least(by_ab, least(by_ac, by_bc));
    const auto inside = least(y, least(t.cy * x - t.cx * y, ex * y - t.cy * fx)) > Float4{};
    return wx * wx + wy * wy + wz * wz + (inside ? -(x * x + y * y) : by_sides);
}

} // namespace anvil

// Distances to triangles in single precision, four at once, with a bound on how far they are off: what
// decides which triangles are worth a look in double precision. Internal to engine/mesh.
#pragma once

#include "engine/core/types.h"
#include "engine/mesh/tree_types.h"

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

/// Four flat triangles.
struct FlatFour {
    std::array<Float4, 3> x_axis;
    std::array<Float4, 3> y_axis;
    Float4 b, cx, cy, ac2_inverse, bc2_inverse, slack;

    void set(size_t lane, const FlatTriangle& triangle);
};

/// The formulas of the kernels, over four triangles.
struct FlatFormulas {
    using real = Float4;
    static Float4 share(const Float4& x) { return clamped(x, four(1)); }
// NOLINTBEGIN: compiled as GLSL too
#include "shaders/shared/flat_triangle.h"
    // NOLINTEND
};

/// Squared distances of points, given from the triangles' origins.
inline Float4 squared_distance(const FlatFour& t, const std::array<Float4, 3>& from_origin) {
    const auto& [wx, wy, wz] = from_origin;
    const Float4 x = t.x_axis[0] * wx + t.x_axis[1] * wy + t.x_axis[2] * wz;
    const Float4 y = t.y_axis[0] * wx + t.y_axis[1] * wy + t.y_axis[2] * wz;
    return FlatFormulas{}.flat_squared_distance(wx * wx + wy * wy + wz * wz, x, y, t.b, t.cx, t.cy,
                                                t.ac2_inverse, t.bc2_inverse);
}

} // namespace anvil

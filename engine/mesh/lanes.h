// Eight points at once, in single precision. Internal to engine/mesh.
#pragma once

#include "engine/mesh/flat_triangle.h"

#include <limits>

// Compiled for AVX2 too, which the program picks where the processor has it, with the same results to the
// bit. Sanitizers are not ready yet when that is picked.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&     \
    !defined(__SANITIZE_THREAD__)
#define ANVIL_FOR_PROCESSOR __attribute__((flatten, target_clones("arch=x86-64-v3", "default")))
#else
#define ANVIL_FOR_PROCESSOR
#endif

namespace anvil {

inline constexpr size_t lanes = 8;
inline constexpr float largest_float = std::numeric_limits<float>::max();

/// One number of each lane. With and without AVX compilers pass these differently: what returns them is for
/// files of which all is inlined into what ANVIL_FOR_PROCESSOR stands before, and what holds them says how it
/// is aligned.
using LaneFloats = float __attribute__((vector_size(4 * lanes)));
using LaneInts = int __attribute__((vector_size(4 * lanes)));
using Double4 = double __attribute__((vector_size(4 * lanes)));

inline constexpr size_t lane_alignment = 4 * lanes;

inline LaneFloats all_lanes(float x) {
    return LaneFloats{x, x, x, x, x, x, x, x};
}

inline LaneFloats least(const LaneFloats& a, const LaneFloats& b) {
    return a < b ? a : b;
}

inline LaneFloats most(const LaneFloats& a, const LaneFloats& b) {
    return a > b ? a : b;
}

inline LaneFloats absolute(const LaneFloats& x) {
    return reinterpret_cast<LaneFloats>(reinterpret_cast<const LaneInts&>(x) & 0x7fffffff);
}

/// What is below zero becomes zero: one instruction for whole numbers, which compare as floats do.
inline LaneFloats not_negative(const LaneFloats& x) {
    const auto& bits = reinterpret_cast<const LaneInts&>(x);
    return reinterpret_cast<LaneFloats>(bits > 0 ? bits : LaneInts{});
}

inline LaneFloats square_root(const LaneFloats& x) {
    const Float4 low = square_root(__builtin_shufflevector(x, x, 0, 1, 2, 3));
    const Float4 high = square_root(__builtin_shufflevector(x, x, 4, 5, 6, 7));
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Bit i: whether number i is negative.
inline unsigned signs(const LaneInts& x) {
    return signs(__builtin_shufflevector(x, x, 0, 1, 2, 3)) | signs(__builtin_shufflevector(x, x, 4, 5, 6, 7))
                                                                  << 4;
}

/// Numbers as exact as they are given, half of the lanes each.
struct alignas(lane_alignment) LaneDoubles {
    std::array<Double4, 2> half{};
};

/// (x - from) * scale
inline LaneFloats narrowed(const LaneDoubles& x, double from, double scale) {
    const Float4 low = __builtin_convertvector((x.half[0] - from) * scale, Float4);
    const Float4 high = __builtin_convertvector((x.half[1] - from) * scale, Float4);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Whether all numbers are negative.
inline bool all_negative(const LaneInts& x) {
    return signs(__builtin_shufflevector(x, x, 0, 1, 2, 3) & __builtin_shufflevector(x, x, 4, 5, 6, 7)) ==
           0xf;
}

/// The formulas of the kernels, over eight points.
struct LaneFormulas {
    using real = LaneFloats;
    static LaneFloats least(const LaneFloats& a, const LaneFloats& b) { return anvil::least(a, b); }
    static LaneFloats clamped(const LaneFloats& x, const LaneFloats& high) {
        return anvil::least(not_negative(x), high);
    }
    static LaneFloats share(const LaneFloats& x) { return clamped(x, all_lanes(1)); }
// NOLINTBEGIN: compiled as GLSL too
#include "shaders/shared/flat_triangle.h"
    // NOLINTEND
};

/// Squared distances from triangle i of four, of points given from its origin.
inline LaneFloats squared_distance(const FlatFour& t, size_t i,
                                   const std::array<LaneFloats, 3>& from_origin) {
    const auto& [wx, wy, wz] = from_origin;
    const LaneFloats x = t.x_axis[0][i] * wx + t.x_axis[1][i] * wy + t.x_axis[2][i] * wz;
    const LaneFloats y = t.y_axis[0][i] * wx + t.y_axis[1][i] * wy + t.y_axis[2][i] * wz;
    return LaneFormulas{}.flat_squared_distance(wx * wx + wy * wy + wz * wz, x, y, all_lanes(t.b[i]),
                                                all_lanes(t.cx[i]), all_lanes(t.cy[i]),
                                                all_lanes(t.ac2_inverse[i]), all_lanes(t.bc2_inverse[i]));
}

} // namespace anvil

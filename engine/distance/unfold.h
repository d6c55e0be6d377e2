// Triangles laid into the plane by their side lengths, in forms that keep their digits on needles.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

namespace anvil {

/// 16 times the squared area of a triangle, Kahan's ordering: no digits lost on needles; 0 where the lengths
/// break the triangle inequality.
inline double sixteen_area_squared(double a, double b, double c) {
    if (a < b) {
        std::swap(a, b);
    }
    if (b < c) {
        std::swap(b, c);
    }
    if (a < b) {
        std::swap(a, b);
    }
    return std::max(0.0, (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c)));
}

struct PlanePoint {
    double x = 0, y = 0;
};

/// Apex (y >= 0) over the base (0,0)-(base,0), at `left` from its start and `right` from its end. base > 0.
inline PlanePoint apex_over(double base, double left, double right) {
    return {0.5 * (base + (left - right) * ((left + right) / base)),
            std::sqrt(sixteen_area_squared(base, left, right)) / (2 * base)};
}

} // namespace anvil

// Triangles laid into the plane by their side lengths, in forms that keep their digits on needles.
#pragma once

#include <algorithm>
#include <cmath>

namespace anvil {

/// 16 times the squared area of a triangle, Kahan's ordering: no digits lost on needles; 0 where the lengths
/// break the triangle inequality.
inline double sixteen_area_squared(double a, double b, double c) {
    // Sorted by extremes: which side is the longest no processor can guess.
    const double larger = std::max(a, b), smaller = std::min(a, b);
    const double first = std::max(larger, c), last = std::min(smaller, c);
    const double middle = std::max(smaller, std::min(larger, c));
    return std::max(0.0, (first + (middle + last)) * (last - (first - middle)) * (last + (first - middle)) *
                             (first + (middle - last)));
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

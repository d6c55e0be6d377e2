#include "engine/mesh/flat_triangle.h"

#include <cmath>

namespace anvil {

namespace {

// Sine of the least angle of triangles whose inside floats can tell.
constexpr double needle_sine = 1e-3;
// Sides shorter than this share of what the scale is for are points.
constexpr double no_length = 1e-12;

float inverse(double squared) {
    return squared > no_length * no_length ? static_cast<float>(1 / squared) : 0;
}

} // namespace

FlatTriangle flattened(const std::array<Vec3, 3>& corners, double scale) {
    FlatTriangle flat;
    double longest = -1;
    for (uint32_t i = 0; i < 3; ++i) {
        const double length = glm::length(corners[(i + 1) % 3] - corners[i]);
        if (length > longest) {
            longest = length;
            flat.origin = i;
        }
    }
    const Vec3 ab = scale * (corners[(flat.origin + 1) % 3] - corners[flat.origin]);
    const Vec3 ac = scale * (corners[(flat.origin + 2) % 3] - corners[flat.origin]);
    const double b = glm::length(ab);
    if (!(b > no_length)) {
        flat.slack = static_cast<float>(2 * b);
        return flat;
    }
    const Vec3 x_axis = ab / b;
    Vec3 c(glm::dot(ac, x_axis), 0, 0);
    const Vec3 up = ac - c.x * x_axis;
    c.y = glm::length(up);
    flat.x_axis = glm::vec3(x_axis);
    flat.b = static_cast<float>(b);
    // The longest side has the two least angles; the sine of each is the height over its other side.
    if (c.y < needle_sine * std::max(std::hypot(c.x, c.y), std::hypot(b - c.x, c.y))) {
        flat.slack = static_cast<float>(2 * c.y);
        c = Vec3(0);
    } else {
        flat.y_axis = glm::vec3(up / c.y);
        flat.c = glm::vec2(c);
    }
    flat.ac2_inverse = inverse(c.x * c.x + c.y * c.y);
    flat.bc2_inverse = inverse((c.x - b) * (c.x - b) + c.y * c.y);
    return flat;
}

void FlatFour::set(size_t lane, const FlatTriangle& triangle) {
    for (int i = 0; i < 3; ++i) {
        x_axis[i][lane] = triangle.x_axis[i];
        y_axis[i][lane] = triangle.y_axis[i];
    }
    b[lane] = triangle.b;
    cx[lane] = triangle.c.x;
    cy[lane] = triangle.c.y;
    ac2_inverse[lane] = triangle.ac2_inverse;
    bc2_inverse[lane] = triangle.bc2_inverse;
    slack[lane] = triangle.slack;
}

} // namespace anvil

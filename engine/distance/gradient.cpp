#include "engine/distance/gradient.h"

#include "engine/core/parallel_for.h"

namespace anvil {
namespace {

Vec3 gradient(const Triangle& t, std::span<const Vec3> positions, std::span<const double> values) {
    const double first = values[t[0]];
    const double rise_b = values[t[1]] - first, rise_c = values[t[2]] - first;
    if (!std::isfinite(rise_b) || !std::isfinite(rise_c)) {
        return Vec3(0);
    }
    // In units of the longer side, so that squares neither vanish nor overflow.
    const Vec3 side_b = positions[t[1]] - positions[t[0]], side_c = positions[t[2]] - positions[t[0]];
    const Vec3 extent = glm::max(glm::abs(side_b), glm::abs(side_c));
    const double unit = std::max({extent.x, extent.y, extent.z});
    if (!(unit > 0)) {
        return Vec3(0);
    }
    const Vec3 b = side_b / unit, c = side_c / unit;
    const double bb = glm::dot(b, b), bc = glm::dot(b, c), cc = glm::dot(c, c);
    const double area = bb * cc - bc * bc;
    // Below this the normal equations have no digits left.
    if (!(area > 1e-24)) {
        return Vec3(0);
    }
    const double along_b = (cc * rise_b - bc * rise_c) / area, along_c = (bb * rise_c - bc * rise_b) / area;
    return (along_b * b + along_c * c) / unit;
}

} // namespace

std::vector<Vec3> face_gradients(std::span<const Triangle> triangles, std::span<const Vec3> positions,
                                 std::span<const double> values) {
    std::vector<Vec3> gradients(triangles.size());
    parallel_for(triangles.size(), 1 << 14, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            gradients[i] = gradient(triangles[i], positions, values);
        }
    });
    return gradients;
}

} // namespace anvil

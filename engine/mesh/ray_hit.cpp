#include "engine/mesh/search_tree.h"

namespace anvil {

namespace {

/// Where a ray enters a box at the latest and leaves it at the earliest, in lengths of its direction.
struct Passage {
    double enter;
    double leave;
};

Passage passage(const Box& box, const Vec3& origin, const Vec3& inverse) {
    const Vec3 a = (box.low - origin) * inverse;
    const Vec3 b = (box.high - origin) * inverse;
    Passage result{0, infinity};
    for (int axis = 0; axis < 3; ++axis) {
        // A ray within a face's plane gives 0 * inf: it does not leave the box there.
        if (std::isnan(a[axis]) || std::isnan(b[axis])) {
            continue;
        }
        result.enter = std::max(result.enter, std::min(a[axis], b[axis]));
        result.leave = std::min(result.leave, std::max(a[axis], b[axis]));
    }
    return result;
}

} // namespace

ClosestPoint SearchTree::first_hit(const Vec3& origin, const Vec3& direction) const {
    ClosestPoint best;
    const Vec3 inverse = 1.0 / direction;
    const auto reached = [&](const Box& box) {
        const Passage at = passage(box, origin, inverse);
        const double slack = 1e-12 * (std::abs(at.enter) + 1);
        return at.enter <= at.leave + slack && at.enter <= best.distance;
    };
    each_leaf(reached, [&](const Node& leaf) {
        for (uint32_t slot = leaf.first; slot < leaf.first + leaf.count; ++slot) {
            const Corners& t = corners_[slot];
            const Vec3 ab = t.b - t.a;
            const Vec3 ac = t.c - t.a;
            const Vec3 across = glm::cross(direction, ac);
            const double determinant = glm::dot(ab, across);
            if (determinant == 0) {
                continue; // seen from the side, or without area
            }
            const Vec3 arm = origin - t.a;
            const Vec3 along = glm::cross(arm, ab);
            const double v = glm::dot(arm, across) / determinant;
            const double w = glm::dot(direction, along) / determinant;
            const double distance = glm::dot(ac, along) / determinant;
            constexpr double edge = 1e-12; // two triangles leave no gap between them
            if (v >= -edge && w >= -edge && v + w <= 1 + edge && distance >= 0 && distance < best.distance) {
                const Vec3 weights = glm::max(Vec3(1 - v - w, v, w), Vec3(0));
                best.triangle = order_[slot];
                best.barycentric = weights / (weights.x + weights.y + weights.z);
                best.position =
                    best.barycentric.x * t.a + best.barycentric.y * t.b + best.barycentric.z * t.c;
                best.distance = distance;
            }
        }
        return true;
    });
    return best;
}

} // namespace anvil

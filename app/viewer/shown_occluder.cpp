#include "app/viewer/shown_occluder.h"

#include "engine/occluder/shape_nodes.h"

namespace anvil {

Vec3 pivot_of(const OccluderShape& shape, const Box& surface) {
    return has_formula(shape) || surface.empty() ? Vec3(0) : surface.centre();
}

Vec3 placed_point(const Transform& transform, const Vec3& point) {
    const Placement place = placement(transform);
    return place.origin +
           place.scale * (place.axes[0] * point.x + place.axes[1] * point.y + place.axes[2] * point.z);
}

std::optional<size_t> first_occluder(const Ray& ray, std::span<const OccluderView> occluders,
                                     std::span<const Transform> shown_at) {
    std::optional<size_t> first;
    double nearest = infinity;
    for (size_t i = 0; i < occluders.size(); ++i) {
        if (!occluders[i].tree) {
            continue;
        }
        const Placement place = placement(shown_at[i]);
        const auto turned_back = [&](const Vec3& v) {
            return Vec3(glm::dot(v, place.axes[0]), glm::dot(v, place.axes[1]), glm::dot(v, place.axes[2]));
        };
        // As long in the occluder's space as in the world, so that distances compare.
        const ClosestPoint found = occluders[i].tree->first_hit(
            turned_back(ray.origin - place.origin) / place.scale, turned_back(ray.direction) / place.scale);
        if (found.found() && found.distance < nearest) {
            nearest = found.distance;
            first = i;
        }
    }
    return first;
}

} // namespace anvil

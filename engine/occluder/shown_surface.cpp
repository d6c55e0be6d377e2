#include "engine/occluder/shown_surface.h"

namespace anvil {

namespace {

/// A square of a plane around the place nearest to `near`.
Mesh plane_patch(const PlaneShape& plane, const Vec3& near, double half) {
    const Vec3 n = plane.normal / glm::length(plane.normal);
    const Vec3 u = glm::normalize(glm::cross(n, std::abs(n.x) < 0.7 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
    const Vec3 v = glm::cross(n, u);
    const Vec3 centre = near - (glm::dot(n, near) - plane.offset) * n;
    Mesh mesh;
    mesh.positions = {centre + half * (u + v), centre + half * (v - u), centre - half * (u + v),
                      centre + half * (u - v)};
    mesh.add_polygon(std::array<uint32_t, 4>{0, 1, 2, 3});
    triangulate(mesh);
    return mesh;
}

} // namespace

Mesh shown_surface(const OccluderShape& shape, const Placement& place, const Box& scene,
                   const SolidSource& source, int cells) {
    if (const auto* plane = std::get_if<PlaneShape>(&shape.solid)) {
        const Vec3 arm = (scene.centre() - place.origin) / place.scale;
        const Vec3 near(glm::dot(place.axes[0], arm), glm::dot(place.axes[1], arm),
                        glm::dot(place.axes[2], arm));
        return plane_patch(*plane, near, 0.6 * scene.diagonal() / place.scale);
    }
    return is_bounded(shape) ? solid_surface(shape, source, cells) : Mesh();
}

} // namespace anvil

#include "app/viewer/pick_surface.h"

namespace anvil {

PickSurface::PickSurface(const Mesh& mesh, const RefinementHistory& history, std::span<const Vec3> positions)
    : mesh_(mesh), history_(history), positions_(positions), tree_(positions, mesh.triangles) {}

SurfaceHit PickSurface::at(const SurfacePoint& point) const {
    const Triangle& t = mesh_.triangles[point.triangle];
    const Vec3 normal = glm::cross(positions_[t[1]] - positions_[t[0]], positions_[t[2]] - positions_[t[0]]);
    const double length = glm::length(normal);
    return {face_address(history_.first_mesh(), history_.find_first(mesh_.triangles, point)), point,
            anvil::position(mesh_, positions_, point), length > 0 ? normal / length : Vec3(0)};
}

std::optional<SurfaceHit> PickSurface::hit(const Ray& ray) const {
    const ClosestPoint found = tree_.first_hit(ray.origin, ray.direction);
    if (!found.found()) {
        return std::nullopt;
    }
    return at({found.triangle, found.barycentric});
}

std::optional<Vec3> PickSurface::position(const SurfaceAddress& address) const {
    if (const auto* vertex = std::get_if<VertexAddress>(&address)) {
        return vertex->vertex < positions_.size() ? std::optional(positions_[vertex->vertex]) : std::nullopt;
    }
    if (const auto* face = std::get_if<FaceAddress>(&address)) {
        const Mesh& first = history_.first_mesh();
        if (face->face >= first.polygon_count() || face->triangle >= first.polygon(face->face).size() - 2) {
            return std::nullopt;
        }
        const auto root = static_cast<uint32_t>(first.first_triangle(face->face) + face->triangle);
        const auto& b = face->barycentric;
        return anvil::position(mesh_, positions_,
                               history_.find(mesh_.triangles, root, Vec3(b[0], b[1], b[2])));
    }
    const ClosestPoint found = tree_.closest(std::get<NearestAddress>(address).point);
    return found.found() ? std::optional(found.position) : std::nullopt;
}

} // namespace anvil

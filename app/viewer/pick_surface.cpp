#include "app/viewer/pick_surface.h"

namespace anvil {

namespace {

std::vector<Triangle> chosen(const Mesh& mesh, const std::vector<uint32_t>& numbers) {
    std::vector<Triangle> triangles;
    triangles.reserve(numbers.size());
    for (const uint32_t t : numbers) {
        triangles.push_back(mesh.triangles[t]);
    }
    return triangles;
}

} // namespace

PickSurface::PickSurface(const Mesh& mesh, const RefinementHistory& history, std::span<const Vec3> positions)
    : mesh_(mesh), history_(history), positions_(positions), tree_(positions, mesh.triangles) {}

PickSurface::PickSurface(const Mesh& mesh, const RefinementHistory& history, std::span<const Vec3> positions,
                         std::vector<uint32_t> triangles)
    : mesh_(mesh), history_(history), positions_(positions), numbers_(std::move(triangles)),
      tree_(positions, chosen(mesh, numbers_)) {}

ClosestPoint PickSurface::of_mesh(ClosestPoint found) const {
    if (found.found() && !numbers_.empty()) {
        found.triangle = numbers_[found.triangle];
    }
    return found;
}

ClosestPoint PickSurface::first_hit(const Ray& ray) const {
    return of_mesh(tree_.first_hit(ray.origin, ray.direction));
}

SurfaceHit PickSurface::at(const SurfacePoint& point) const {
    const Triangle& t = mesh_.triangles[point.triangle];
    const Vec3 normal = glm::cross(positions_[t[1]] - positions_[t[0]], positions_[t[2]] - positions_[t[0]]);
    const double length = glm::length(normal);
    return {face_address(history_.first_mesh(), history_.find_first(mesh_.triangles, point)), point,
            anvil::position(mesh_, positions_, point), length > 0 ? normal / length : Vec3(0)};
}

std::optional<SurfaceHit> PickSurface::hit(const Ray& ray) const {
    const ClosestPoint found = first_hit(ray);
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

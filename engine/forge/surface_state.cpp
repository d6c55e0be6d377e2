#include "engine/forge/surface_state.h"

#include "engine/core/error.h"

namespace anvil {

namespace {

std::string range(size_t count) {
    return count == 0 ? "there are none" : "0 to " + std::to_string(count - 1);
}

} // namespace

SurfacePoint SurfaceState::at_vertex(uint32_t vertex, const std::string& place) {
    const size_t count = history_.first_mesh().vertex_count();
    if (vertex >= count) {
        throw InputError(place + ": vertex " + std::to_string(vertex) + " is out of range: the mesh has " +
                         std::to_string(count) + " vertices (" + range(count) + ")");
    }
    return vertex_point(mesh_, vertex);
}

SurfacePoint SurfaceState::at_face(const FaceAddress& address, const std::string& place) const {
    const Mesh& file = history_.first_mesh();
    if (address.face >= file.polygon_count()) {
        throw InputError(place + ": face " + std::to_string(address.face) +
                         " is out of range: the mesh has " + std::to_string(file.polygon_count()) +
                         " faces (" + range(file.polygon_count()) + ")");
    }
    const size_t first = file.first_triangle(address.face);
    const size_t count = file.first_triangle(address.face + size_t{1}) - first;
    if (address.triangle >= count) {
        throw InputError(place + ": triangle " + std::to_string(address.triangle) +
                         " is out of range: face " + std::to_string(address.face) + " has " +
                         std::to_string(count) + " (" + range(count) + ")");
    }
    const auto& b = address.barycentric;
    return history_.find(mesh_.triangles, static_cast<uint32_t>(first + address.triangle),
                         Vec3(b[0], b[1], b[2]));
}

SurfacePoint SurfaceState::near(const Vec3& point, const std::string& place) {
    if (!tree_) {
        tree_ = std::make_unique<SearchTree>(positions_, mesh_.triangles);
    }
    const ClosestPoint found = tree_->closest(point);
    if (!found.found()) {
        throw InputError(place + ": there is no surface point near to it: the mesh has no triangle");
    }
    SurfacePoint result;
    result.triangle = found.triangle;
    result.barycentric = found.barycentric;
    return snapped(result);
}

SurfacePoint SurfaceState::resolve(const SurfaceAddress& address, const std::string& place) {
    if (const auto* vertex = std::get_if<VertexAddress>(&address)) {
        return at_vertex(vertex->vertex, place);
    }
    if (const auto* face = std::get_if<FaceAddress>(&address)) {
        return at_face(*face, place);
    }
    return near(std::get<NearestAddress>(address).point, place);
}

DistanceField SurfaceState::distances(std::span<const SurfacePoint> sources, Metric metric,
                                      DistanceMethod method, double radius) {
    if (metric == Metric::euclidean) {
        std::vector<Vec3> points;
        points.reserve(sources.size());
        for (const SurfacePoint& source : sources) {
            points.push_back(position_of(source));
        }
        return euclidean_distances(positions_, points, radius);
    }
    if (!solver_) {
        solver_.emplace(mesh_, positions_);
    }
    return solver_->solve(sources, radius, method);
}

Vec3 SurfaceState::position_of(const SurfacePoint& point) const {
    return position(mesh_, positions_, point);
}

std::vector<VertexWeight> SurfaceState::weights_of(const SurfacePoint& point) const {
    const VertexWeights weights = vertex_weights(mesh_, point);
    return {weights.begin(), weights.end()};
}

} // namespace anvil

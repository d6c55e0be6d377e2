#include "engine/forge/surface_state.h"

#include "engine/core/error.h"
#include "engine/core/parallel_for.h"
#include "engine/distance/anchor_blend.h"

namespace anvil {

namespace {

std::string range(size_t count) {
    return count == 0 ? "there are none" : "0 to " + std::to_string(count - 1);
}

} // namespace

void SurfaceState::check_vertex(uint32_t vertex, const std::string& place) const {
    const size_t count = history_.first_mesh().vertex_count();
    if (vertex >= count) {
        throw InputError(place + ": vertex " + std::to_string(vertex) + " is out of range: the mesh has " +
                         std::to_string(count) + " vertices (" + range(count) + ")");
    }
}

void SurfaceState::check_face(uint32_t face, const std::string& place) const {
    const size_t count = history_.first_mesh().polygon_count();
    if (face >= count) {
        throw InputError(place + ": face " + std::to_string(face) + " is out of range: the mesh has " +
                         std::to_string(count) + " faces (" + range(count) + ")");
    }
}

SurfacePoint SurfaceState::at_face(const FaceAddress& address, const std::string& place) const {
    check_face(address.face, place);
    const Mesh& file = history_.first_mesh();
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

/// As vertex_point(), which looks through the mesh each time.
SurfacePoint SurfaceState::at_vertex(uint32_t vertex) {
    if (first_triangles_.empty()) {
        first_triangles_.assign(positions_.size(), no_index);
        for (size_t t = mesh_.triangles.size(); t-- > 0;) {
            for (const uint32_t v : mesh_.triangles[t]) {
                first_triangles_[v] = static_cast<uint32_t>(t);
            }
        }
    }
    SurfacePoint point{first_triangles_[vertex], Vec3(0), vertex};
    for (int i = 0; point.triangle != no_index && i < 3; ++i) {
        if (mesh_.triangles[point.triangle][i] == vertex) {
            point.barycentric[i] = 1;
            break;
        }
    }
    return point;
}

SurfacePoint SurfaceState::resolve(const SurfaceAddress& address, const std::string& place) {
    if (const auto* vertex = std::get_if<VertexAddress>(&address)) {
        check_vertex(vertex->vertex, place);
        return at_vertex(vertex->vertex);
    }
    if (const auto* face = std::get_if<FaceAddress>(&address)) {
        return at_face(*face, place);
    }
    return near(std::get<NearestAddress>(address).point, place);
}

std::vector<uint32_t> SurfaceState::triangles_of(const WholeFaceAddress& face,
                                                 const std::string& place) const {
    check_face(face.face, place);
    const Mesh& file = history_.first_mesh();
    return history_.parts_of(static_cast<uint32_t>(file.first_triangle(face.face)),
                             static_cast<uint32_t>(file.first_triangle(face.face + size_t{1})));
}

Vec3 SurfaceState::place_of(const SurfaceAddress& address, const std::string& place) {
    if (const auto* vertex = std::get_if<VertexAddress>(&address)) {
        check_vertex(vertex->vertex, place);
        return positions_[vertex->vertex]; // at once: finding its triangle takes O(mesh)
    }
    return position_of(resolve(address, place));
}

Vec3 SurfaceState::centre_of(const WholeFaceAddress& face, const std::string& place) const {
    const std::vector<uint32_t> triangles = triangles_of(face, place);
    Vec3 sum(0);
    for (const uint32_t t : triangles) {
        const Triangle& corners = mesh_.triangles[t];
        sum += positions_[corners[0]] + positions_[corners[1]] + positions_[corners[2]];
    }
    return sum / (3.0 * static_cast<double>(triangles.size()));
}

WholeFaceAddress SurfaceState::face_near(const Vec3& point, const std::string& place) {
    const uint32_t triangle = near(point, place).triangle;
    const uint32_t root = history_.roots().empty() ? triangle : history_.roots()[triangle];
    const Mesh& file = history_.first_mesh();
    uint32_t below = 0, above = static_cast<uint32_t>(file.polygon_count());
    while (above - below > 1) {
        const uint32_t middle = (below + above) / 2;
        (file.first_triangle(middle) <= root ? below : above) = middle;
    }
    return {below};
}

std::vector<SurfacePoint> SurfaceState::line_through(std::span<const SurfacePoint> points,
                                                     uint32_t smooth_rounds, const std::string& place) {
    const GeodesicSolver& surface = solver(smooth_rounds);
    std::vector<SurfacePoint> line(points.begin(), points.begin() + 1);
    for (size_t i = 1; i < points.size(); ++i) {
        const auto joined = surface.share_triangle(points[i - 1], points[i])
                                ? std::vector<SurfacePoint>{points[i - 1], points[i]}
                                : surface.shortest_line(points[i - 1], points[i]);
        if (joined.empty()) {
            throw InputError(place + ": no way along the surface leads from point " + std::to_string(i - 1) +
                             " to point " + std::to_string(i) +
                             ": they lie in different components; give each component a polyline of its own");
        }
        line.insert(line.end(), joined.begin() + 1, joined.end());
    }
    return line;
}

bool SurfaceState::same_place(const SurfacePoint& a, const SurfacePoint& b) const {
    const VertexWeights first = vertex_weights(mesh_, a), second = vertex_weights(mesh_, b);
    const bool inside = first.count == 3 && a.triangle != b.triangle;
    return first.count == second.count && !inside &&
           std::all_of(first.begin(), first.end(), [&](const VertexWeight& w) {
               return std::any_of(second.begin(), second.end(), [&](const VertexWeight& other) {
                   return other.vertex == w.vertex && std::abs(other.weight - w.weight) <= barycentric_snap;
               });
           });
}

DistanceField SurfaceState::straight_distances(const DistanceSources& sources, double radius) const {
    std::vector<Vec3> points;
    std::vector<std::array<Vec3, 3>> triangles;
    for (const SurfacePoint& point : sources.points) {
        points.push_back(position_of(point));
    }
    for (const std::vector<SurfacePoint>& line : sources.polylines) {
        for (size_t i = 1; i < line.size(); ++i) {
            const Vec3 end = position_of(line[i]);
            triangles.push_back({position_of(line[i - 1]), end, end});
        }
    }
    for (const uint32_t t : sources.triangles) {
        const Triangle& corners = mesh_.triangles[t];
        triangles.push_back({positions_[corners[0]], positions_[corners[1]], positions_[corners[2]]});
    }
    return euclidean_distances(positions_, points, triangles, radius);
}

std::vector<DistanceField> SurfaceState::distances(std::span<const DistanceQuery> queries) {
    std::vector<const GeodesicSolver*> solvers;
    for (const DistanceQuery& query : queries) {
        solvers.push_back(query.metric == Metric::geodesic ? &solver(query.smooth_rounds) : nullptr);
    }
    std::vector<DistanceField> fields(queries.size());
    parallel_for(queries.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const DistanceQuery& query = queries[i];
            const auto find = [&](const DistanceSources& sources, double radius) {
                return query.metric == Metric::euclidean ? straight_distances(sources, radius)
                                                         : solvers[i]->solve(sources, radius, query.method);
            };
            fields[i] = anchor_distances(query.anchors, query.radius, query.blend_width, find);
        }
    });
    return fields;
}

Vec3 SurfaceState::position_of(const SurfacePoint& point) const {
    return position(mesh_, positions_, point);
}

std::vector<VertexWeight> SurfaceState::weights_of(const SurfacePoint& point) const {
    const VertexWeights weights = vertex_weights(mesh_, point);
    return {weights.begin(), weights.end()};
}

} // namespace anvil

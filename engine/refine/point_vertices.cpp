#include "engine/refine/point_vertices.h"

#include "engine/core/error.h"
#include "engine/refine/refined_places.h"

#include <numeric>

namespace anvil {

namespace {

/// The triangles that share a vertex with one that holds a point: splits reach no farther.
std::vector<uint32_t> triangles_near(const Mesh& mesh, std::span<const SurfacePoint> points) {
    std::vector<char> touched(mesh.vertex_count(), 0);
    for (const SurfacePoint& point : points) {
        for (int i = 0; i < 3 && point.triangle != no_index; ++i) {
            touched[mesh.triangles[point.triangle][i]] = 1;
        }
    }
    std::vector<uint32_t> chosen;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& corners = mesh.triangles[t];
        if (touched[corners[0]] || touched[corners[1]] || touched[corners[2]]) {
            chosen.push_back(t);
        }
    }
    return chosen;
}

class PointInserter {
  public:
    PointInserter(const Mesh& mesh, std::span<const SurfacePoint> points)
        : mesh_(mesh), net_(mesh.triangles, triangles_near(mesh, points), mesh.vertex_count()) {}

    uint32_t insert(const SurfacePoint& point) {
        if (point.triangle == no_index) {
            return point.vertex;
        }
        uint32_t face = face_of(point);
        Vec3 weights = weights_in(face, point);
        if (std::min({weights.x, weights.y, weights.z}) > 0) {
            // Through the longest edge, so that no part is thinner than it must be.
            const int apex = opposite_of_longest_edge(face);
            split((apex + 1) % 3, face, weights);
            face = face_of(point);
            weights = weights_in(face, point);
        }
        for (int i = 0; i < 3; ++i) {
            if (weights[i] == 1) {
                return net_.faces()[face].corners[i];
            }
        }
        for (int i = 0; i < 3; ++i) {
            if (weights[(i + 2) % 3] == 0) {
                return split(i, face, weights);
            }
        }
        throw InternalError("a point on a cut of its face was not found on an edge");
    }

    PointVertices finish(std::vector<uint32_t> vertices) {
        return {divided(mesh_, std::move(parents_), net_.faces()), std::move(vertices)};
    }

  private:
    RootPlaces places_in(uint32_t root) const {
        return {mesh_.triangles[root], mesh_.vertex_count(), parents_};
    }

    uint32_t face_of(const SurfacePoint& point) const {
        RootPlaces places = places_in(point.triangle);
        uint32_t best = no_index;
        double deepest = -infinity;
        for (uint32_t f = 0; f < net_.faces().size(); ++f) {
            if (net_.faces()[f].root == point.triangle) {
                const Vec3 inside = places.within(net_.faces()[f].corners, point.barycentric);
                const double depth = std::min({inside.x, inside.y, inside.z});
                if (best == no_index || depth > deepest) {
                    deepest = depth;
                    best = f;
                }
            }
        }
        return best;
    }

    Vec3 weights_in(uint32_t face, const SurfacePoint& point) const {
        RootPlaces places = places_in(point.triangle);
        return snapped({face, places.within(net_.faces()[face].corners, point.barycentric)}).barycentric;
    }

    Vec3 position_of(uint32_t vertex) const {
        if (vertex < mesh_.vertex_count()) {
            return mesh_.positions[vertex];
        }
        const VertexParents& p = parents_[vertex - mesh_.vertex_count()];
        return between(position_of(p.a), position_of(p.b), p.place);
    }

    int opposite_of_longest_edge(uint32_t face) const {
        const Triangle& corners = net_.faces()[face].corners;
        int apex = 0;
        double longest = -1;
        for (int i = 0; i < 3; ++i) {
            const double length =
                glm::distance(position_of(corners[(i + 1) % 3]), position_of(corners[(i + 2) % 3]));
            if (length > longest) {
                longest = length;
                apex = i;
            }
        }
        return apex;
    }

    /// Splits the edge from corner `side` of a face where the weights of its ends say.
    uint32_t split(int side, uint32_t face, const Vec3& weights) {
        const uint32_t edge = net_.faces()[face].edges[side];
        const uint32_t from = net_.faces()[face].corners[side];
        const EdgeMesh::Edge ends = net_.edges()[edge];
        const double sum = weights[side] + weights[(side + 1) % 3];
        const double place = (ends.a == from ? weights[(side + 1) % 3] : weights[side]) / sum;
        parents_.push_back({ends.a, ends.b, place});
        const auto vertex = static_cast<uint32_t>(mesh_.vertex_count() + parents_.size() - 1);
        net_.mark(edge, vertex);
        std::vector<uint32_t> faces(net_.faces().size());
        std::iota(faces.begin(), faces.end(), 0U);
        net_.split(faces, [](uint32_t, uint32_t, uint32_t, uint32_t) { return true; });
        return vertex;
    }

    const Mesh& mesh_;
    EdgeMesh net_;
    std::vector<VertexParents> parents_;
};

} // namespace

PointVertices make_vertices(const Mesh& mesh, std::span<const SurfacePoint> points) {
    std::vector<SurfacePoint> places;
    places.reserve(points.size());
    for (const SurfacePoint& point : points) {
        places.push_back(snapped(point));
    }
    PointInserter inserter(mesh, places);
    std::vector<uint32_t> vertices;
    vertices.reserve(places.size());
    for (const SurfacePoint& place : places) {
        vertices.push_back(inserter.insert(place));
    }
    return inserter.finish(std::move(vertices));
}

} // namespace anvil

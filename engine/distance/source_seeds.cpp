#include "engine/distance/source_seeds.h"

#include "engine/core/error.h"
#include "engine/distance/unfold.h"

namespace anvil {
namespace {

constexpr double snap = 1e-12;

[[noreturn]] void reject(size_t source, const std::string& found, const std::string& mend) {
    throw InputError("distance source " + std::to_string(source) + ": " + found + "; " + mend);
}

void check(const TriangleGraph& graph, const SurfacePoint& point, size_t index) {
    if (point.triangle == no_index) {
        if (point.vertex >= graph.vertex_count()) {
            reject(index, "vertex " + std::to_string(point.vertex) + " is not in the mesh",
                   "the mesh has " + std::to_string(graph.vertex_count()) + " vertices, counted from 0");
        }
        return;
    }
    if (point.triangle >= graph.triangle_count()) {
        reject(index, "triangle " + std::to_string(point.triangle) + " is not in the mesh",
               "the mesh has " + std::to_string(graph.triangle_count()) + " triangles, counted from 0");
    }
    const Vec3& w = point.barycentric;
    const double sum = w.x + w.y + w.z;
    if (!(w.x >= -snap && w.y >= -snap && w.z >= -snap && std::abs(sum - 1) <= 1e-6)) {
        reject(index, "its barycentric weights are no point of the triangle",
               "give three weights >= 0 with sum 1");
    }
}

/// Straight distances from a point of the triangle that starts at side `base` to its three corners; the point
/// is given by its weights at the base's end and at the apex.
struct CornerDistances {
    double start, end, apex;
};
CornerDistances corner_distances(const TriangleGraph& graph, uint32_t base, double weight_end,
                                 double weight_apex) {
    const double length = graph.side_length[base];
    const double left = graph.side_length[TriangleGraph::previous(base)];
    const double right = graph.side_length[TriangleGraph::next(base)];
    if (length == 0) {
        return {weight_apex * left, weight_apex * left, (1 - weight_apex) * left};
    }
    const PlanePoint apex = apex_over(length, left, right);
    const double x = weight_end * length + weight_apex * apex.x;
    const double y = weight_apex * apex.y;
    return {std::hypot(x, y), std::hypot(length - x, y), std::hypot(apex.x - x, apex.y - y)};
}

class Seeder {
  public:
    Seeder(const TriangleGraph& graph, uint32_t label, std::vector<Seed>& seeds)
        : graph_(graph), label_(label), seeds_(seeds) {}

    void add(const SurfacePoint& point) {
        if (point.triangle == no_index) {
            seeds_.push_back({point.vertex, label_, 0});
            return;
        }
        const Vec3 weights = glm::max(point.barycentric, Vec3(0)) /
                             (std::max(point.barycentric.x, 0.0) + std::max(point.barycentric.y, 0.0) +
                              std::max(point.barycentric.z, 0.0));
        const uint32_t first = 3 * point.triangle;
        for (int k = 0; k < 3; ++k) {
            if (weights[k] >= 1 - snap) {
                seeds_.push_back({graph_.corner_vertex[first + k], label_, 0});
                return;
            }
        }
        for (int k = 0; k < 3; ++k) {
            if (weights[k] <= snap) {
                add_edge_point(first + (k + 1) % 3, weights[(k + 2) % 3]);
                return;
            }
        }
        add_in_triangle(first, weights[1], weights[2]);
    }

  private:
    void add_in_triangle(uint32_t base, double weight_end, double weight_apex) {
        const CornerDistances d = corner_distances(graph_, base, weight_end, weight_apex);
        seeds_.push_back({graph_.corner_vertex[base], label_, d.start});
        seeds_.push_back({graph_.corner_vertex[TriangleGraph::next(base)], label_, d.end});
        seeds_.push_back({graph_.corner_vertex[TriangleGraph::previous(base)], label_, d.apex});
    }

    void add_edge_point(uint32_t side, double weight_end) {
        const uint32_t from = graph_.corner_vertex[side];
        const uint32_t to = graph_.corner_vertex[TriangleGraph::next(side)];
        for (const uint32_t leaving : graph_.sides_leaving(from)) {
            const uint32_t arriving = TriangleGraph::previous(leaving);
            if (graph_.corner_vertex[TriangleGraph::next(leaving)] == to) {
                add_in_triangle(leaving, weight_end, 0);
            } else if (graph_.corner_vertex[arriving] == to) {
                add_in_triangle(arriving, 1 - weight_end, 0);
            }
        }
    }

    const TriangleGraph& graph_;
    uint32_t label_;
    std::vector<Seed>& seeds_;
};

} // namespace

std::vector<Seed> seed_sources(const TriangleGraph& graph, std::span<const SurfacePoint> sources) {
    std::vector<Seed> seeds;
    for (size_t i = 0; i < sources.size(); ++i) {
        check(graph, sources[i], i);
        Seeder(graph, static_cast<uint32_t>(i), seeds).add(sources[i]);
    }
    return seeds;
}

} // namespace anvil

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

class Seeder {
  public:
    Seeder(const TriangleGraph& graph, uint32_t label, std::vector<Seed>& seeds)
        : graph_(graph), label_(label), seeds_(seeds) {}

    void add(const SurfacePoint& point) {
        if (point.triangle == no_index) {
            seeds_.push_back({graph_.numbering.new_vertex[point.vertex], label_, 0, no_index, 0});
            return;
        }
        const Vec3 weights = glm::max(point.barycentric, Vec3(0)) /
                             (std::max(point.barycentric.x, 0.0) + std::max(point.barycentric.y, 0.0) +
                              std::max(point.barycentric.z, 0.0));
        const uint32_t first = 3 * graph_.numbering.new_triangle[point.triangle];
        for (int k = 0; k < 3; ++k) {
            if (weights[k] >= 1 - snap) {
                seeds_.push_back({graph_.corner_vertex[first + k], label_, 0, no_index, 0});
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
    /// The point has weights (1 - weight_end - weight_apex, weight_end, weight_apex) at base's start, its end
    /// and the apex.
    void add_in_triangle(uint32_t base, double weight_end, double weight_apex) {
        const uint32_t second = TriangleGraph::next(base), third = TriangleGraph::previous(base);
        const double length = graph_.side_length[base];
        const double left = graph_.side_length[third];
        PlanePoint apex{left, 0};
        if (length > 0) {
            apex = apex_over(length, left, graph_.side_length[second]);
        }
        const PlanePoint point{weight_end * length + weight_apex * apex.x, weight_apex * apex.y};
        const std::array<PlanePoint, 3> corners = {{{0, 0}, {length, 0}, apex}};
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t side = k == 0 ? base : k == 1 ? second : third;
            const PlanePoint& here = corners[k];
            const PlanePoint& next = corners[(k + 1) % 3];
            const double ax = next.x - here.x, ay = next.y - here.y;
            const double bx = point.x - here.x, by = point.y - here.y;
            const double angle = std::atan2(std::max(0.0, ax * by - ay * bx), ax * bx + ay * by);
            seeds_.push_back({graph_.corner_vertex[side], label_, std::hypot(bx, by), side, angle});
        }
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

#include "engine/distance/triangle_graph.h"

#include "engine/core/parallel_for.h"

namespace anvil {
namespace {

double power_of_two_near(double extent) {
    if (!(extent > 0)) {
        return 1;
    }
    // Beyond these exponents the inverse would not be a normal number.
    return std::ldexp(1.0, std::clamp(std::ilogb(extent), -1000, 1000));
}

void measure_sides(TriangleGraph& graph, std::span<const Vec3> positions) {
    graph.side_length.resize(graph.corner_vertex.size());
    const double inverse = 1 / graph.unit;
    const std::vector<uint32_t>& mesh_vertex = graph.numbering.mesh_vertex;
    parallel_for(graph.triangle_count(), 1 << 14, [&](size_t begin, size_t end) {
        for (size_t side = 3 * begin; side < 3 * end; ++side) {
            const Vec3& from = positions[mesh_vertex[graph.corner_vertex[side]]];
            const Vec3& to = positions[mesh_vertex[graph.to(static_cast<uint32_t>(side))]];
            graph.side_length[side] = glm::length((to - from) * inverse);
        }
    });
    for (const double length : graph.side_length) {
        graph.longest_side = std::max(graph.longest_side, length);
    }
}

/// One end of an edge: the other vertex, and the side.
struct EdgeSide {
    uint32_t other, side;
};

bool has_corner_twice(const TriangleGraph& graph, uint32_t side) {
    const uint32_t first = side - side % 3;
    const uint32_t a = graph.corner_vertex[first], b = graph.corner_vertex[first + 1],
                   c = graph.corner_vertex[first + 2];
    return a == b || b == c || c == a;
}

/// Joins into rings the sides that lead from `vertex` to higher vertices, so that each edge is done once.
void link_edges_of(TriangleGraph& graph, uint32_t vertex, std::vector<EdgeSide>& ends) {
    ends.clear();
    for (const uint32_t side : graph.sides_leaving(vertex)) {
        if (has_corner_twice(graph, side)) {
            continue;
        }
        const uint32_t arriving = TriangleGraph::previous(side);
        if (graph.to(side) > vertex) {
            ends.push_back({graph.to(side), side});
        }
        if (graph.from(arriving) > vertex) {
            ends.push_back({graph.from(arriving), arriving});
        }
    }
    std::sort(ends.begin(), ends.end(), [](const EdgeSide& a, const EdgeSide& b) {
        return a.other != b.other ? a.other < b.other : a.side < b.side;
    });
    for (size_t begin = 0, end = 0; begin < ends.size(); begin = end) {
        while (end < ends.size() && ends[end].other == ends[begin].other) {
            ++end;
        }
        for (size_t i = begin; i < end && end - begin > 1; ++i) {
            const uint32_t here = ends[i].side, there = ends[i + 1 < end ? i + 1 : begin].side;
            graph.across[here] = 2 * there + (graph.from(here) == graph.from(there) ? 1 : 0);
        }
    }
}

void link_edges(TriangleGraph& graph) {
    graph.across.assign(graph.corner_vertex.size(), no_index);
    parallel_for(graph.vertex_count(), 1 << 12, [&](size_t begin, size_t end) {
        std::vector<EdgeSide> ends;
        for (size_t v = begin; v < end; ++v) {
            link_edges_of(graph, static_cast<uint32_t>(v), ends);
        }
    });
}

} // namespace

void link_vertices(TriangleGraph& graph, size_t vertex_count) {
    std::vector<uint32_t>& begin = graph.leaving_begin;
    begin.assign(vertex_count + 1, 0);
    for (const uint32_t v : graph.corner_vertex) {
        ++begin[v + 1];
    }
    for (size_t v = 0; v < vertex_count; ++v) {
        begin[v + 1] += begin[v];
    }
    graph.leaving.resize(graph.corner_vertex.size());
    std::vector<uint32_t> place(begin.begin(), begin.end() - 1);
    for (uint32_t side = 0; side < graph.corner_vertex.size(); ++side) {
        graph.leaving[place[graph.corner_vertex[side]]++] = side;
    }
}

TriangleGraph make_triangle_graph(std::span<const Triangle> triangles, std::span<const Vec3> positions,
                                  Numbering numbering) {
    TriangleGraph graph;
    graph.numbering = std::move(numbering);
    Box box;
    for (const Vec3& p : positions) {
        box.include(p);
    }
    graph.unit = power_of_two_near(box.diagonal());
    graph.corner_vertex.resize(3 * triangles.size());
    for (size_t t = 0; t < triangles.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            graph.corner_vertex[3 * graph.numbering.new_triangle[t] + k] =
                graph.numbering.new_vertex[triangles[t][k]];
        }
    }
    measure_sides(graph, positions);
    link_vertices(graph, positions.size());
    link_edges(graph);
    return graph;
}

} // namespace anvil

#include "engine/distance/triangle_graph.h"

#include "engine/core/large_pages.h"
#include "engine/core/parallel_for.h"

#include <mutex>

namespace anvil {
namespace {

double power_of_two_near(double extent) {
    if (!(extent > 0)) {
        return 1;
    }
    // Beyond these exponents the inverse would not be a normal number.
    return std::ldexp(1.0, std::clamp(std::ilogb(extent), -1000, 1000));
}

void set_places(TriangleGraph& graph, std::span<const Vec3> positions) {
    const double inverse = 1 / graph.unit;
    fill_large(graph.places, positions.size(), with_room(positions.size()));
    parallel_for(positions.size(), 1 << 14, [&](size_t begin, size_t end) {
        for (size_t v = begin; v < end; ++v) {
            graph.places[v] = positions[graph.numbering.mesh_vertex[v]] * inverse;
        }
    });
    std::mutex mutex;
    parallel_for(graph.corner_vertex.size(), 1 << 14, [&](size_t begin, size_t end) {
        double longest = 0; // squared
        for (size_t side = begin; side < end; ++side) {
            const auto s = static_cast<uint32_t>(side);
            const Vec3 along = graph.places[graph.to(s)] - graph.places[graph.from(s)];
            longest = std::max(longest, glm::dot(along, along));
        }
        const std::scoped_lock lock(mutex);
        graph.longest_side = std::max(graph.longest_side, std::sqrt(longest));
    });
}

void link_edges(TriangleLinks& graph) {
    graph.across.reserve(with_room(graph.corner_vertex.size()));
    graph.across.assign(graph.corner_vertex.size(), no_index);
    parallel_for(graph.vertex_count(), 1 << 12, [&](size_t begin, size_t end) {
        std::vector<EdgeSide> ends;
        for (size_t v = begin; v < end; ++v) {
            link_edges_of(graph, static_cast<uint32_t>(v), ends);
        }
    });
}

} // namespace

double unit_of(std::span<const Vec3> positions) {
    Box box;
    for (const Vec3& p : positions) {
        box.include(p);
    }
    return power_of_two_near(box.diagonal());
}

MeasuredTriangle measured(const TriangleGraph& graph, uint32_t triangle) {
    MeasuredTriangle result{};
    std::array<Vec3, 3> along;
    for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t side = 3 * triangle + k;
        along[k] = graph.places[graph.to(side)] - graph.places[graph.from(side)];
        result.length[k] = glm::length(along[k]);
    }
    const auto shortest = std::min_element(result.length.begin(), result.length.end());
    const auto k = static_cast<uint32_t>(shortest - result.length.begin());
    result.shortest = k;
    result.dot = -glm::dot(along[k], along[(k + 2) % 3]);
    result.double_area = glm::length(glm::cross(along[k], along[(k + 2) % 3]));
    return result;
}

PlanePoint MeasuredTriangle::direction_of_apex(uint32_t k) const {
    // The dot product at each corner from the one at the start of the shortest side, where none cancels.
    const uint32_t corner = (k + 3 - shortest) % 3;
    const double next_to_it = corner == 0 ? 0 : length[corner == 1 ? shortest : (shortest + 2) % 3];
    const double here = corner == 0 ? dot : next_to_it * next_to_it - dot;
    const double size = std::hypot(here, double_area);
    return size > 0 ? PlanePoint{here / size, double_area / size} : PlanePoint{1, 0};
}

PlanePoint direction_of_apex(const TriangleGraph& graph, uint32_t side) {
    return measured(graph, side / 3).direction_of_apex(side % 3);
}

void link_vertices(TriangleLinks& graph, size_t vertex_count) {
    std::vector<uint32_t>& begin = graph.leaving_begin;
    begin.reserve(with_room(vertex_count + 1));
    begin.assign(vertex_count + 1, 0);
    for (const uint32_t v : graph.corner_vertex) {
        ++begin[v + 1];
    }
    for (size_t v = 0; v < vertex_count; ++v) {
        begin[v + 1] += begin[v];
    }
    fill_large(graph.leaving, graph.corner_vertex.size(), with_room(graph.corner_vertex.size()));
    std::vector<uint32_t> place(begin.begin(), begin.end() - 1);
    for (uint32_t side = 0; side < graph.corner_vertex.size(); ++side) {
        graph.leaving[place[graph.corner_vertex[side]]++] = side;
    }
}

namespace {

/// Joins sides of one edge into a ring. @param ends: ascending by side
void join(TriangleLinks& graph, std::span<const EdgeSide> ends) {
    for (size_t i = 0; i < ends.size(); ++i) {
        const uint32_t here = ends[i].side, there = ends[i + 1 < ends.size() ? i + 1 : 0].side;
        graph.across[here] = 2 * there + (graph.from(here) == graph.from(there) ? 1 : 0);
    }
}

/// The edges of a vertex with few corners, of one or two sides each, as nearly all are. Nothing here branches
/// on what comes, which no processor could guess.
/// @return false if it is no such vertex
bool join_pairs(TriangleLinks& graph, uint32_t vertex) {
    constexpr size_t most = 12;
    const std::span<const uint32_t> leaving = graph.sides_leaving(vertex);
    if (leaving.size() > most) {
        return false;
    }
    std::array<EdgeSide, 2 * most + 2> ends;
    size_t count = 0;
    for (const uint32_t side : leaving) {
        const uint32_t arriving = TriangleLinks::previous(side);
        const uint32_t to = graph.to(side), from = graph.from(arriving);
        if (to == vertex || from == vertex || to == from) {
            return false;
        }
        ends[count] = {to, side};
        count += to > vertex ? 1 : 0;
        ends[count] = {from, arriving};
        count += from > vertex ? 1 : 0;
    }
    for (size_t i = 0; i < count; ++i) {
        size_t like = 0, partners = 0;
        for (size_t j = 0; j < count; ++j) {
            const size_t same = ends[j].other == ends[i].other ? 1 : 0;
            like += same;
            partners += same * j;
        }
        if (like > 2) {
            return false;
        }
        const uint32_t here = ends[i].side, there = ends[partners - (like - 1) * i].side;
        graph.across[here] =
            like == 1 ? no_index : 2 * there + (graph.from(here) == graph.from(there) ? 1 : 0);
    }
    return true;
}

} // namespace

/// Joins the sides of each edge into a ring; each edge is done at its lower vertex, once.
void link_edges_of(TriangleLinks& graph, uint32_t vertex, std::vector<EdgeSide>& ends) {
    if (join_pairs(graph, vertex)) {
        return;
    }
    ends.clear();
    const auto add = [&](uint32_t other, uint32_t side) {
        if (other > vertex) {
            ends.push_back({other, side});
        }
    };
    for (const uint32_t side : graph.sides_leaving(vertex)) {
        const uint32_t arriving = TriangleLinks::previous(side);
        const uint32_t to = graph.to(side), from = graph.from(arriving);
        // Not of triangles with a corner twice.
        if (to != vertex && from != vertex && to != from) {
            add(to, side);
            add(from, arriving);
        }
    }
    std::sort(ends.begin(), ends.end(), [](const EdgeSide& a, const EdgeSide& b) {
        return (uint64_t{a.other} << 32 | a.side) < (uint64_t{b.other} << 32 | b.side);
    });
    for (size_t begin = 0, end = 0; begin < ends.size(); begin = end) {
        while (end < ends.size() && ends[end].other == ends[begin].other) {
            ++end;
        }
        if (end - begin == 1) {
            graph.across[ends[begin].side] = no_index;
        } else {
            join(graph, {ends.data() + begin, end - begin});
        }
    }
}

TriangleGraph make_triangle_graph(std::span<const Triangle> triangles, std::span<const Vec3> positions,
                                  Numbering numbering) {
    TriangleGraph graph;
    graph.numbering = std::move(numbering);
    graph.unit = unit_of(positions);
    fill_large(graph.corner_vertex, 3 * triangles.size(), with_room(3 * triangles.size()));
    for (size_t t = 0; t < triangles.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            graph.corner_vertex[3 * graph.numbering.new_triangle[t] + k] =
                graph.numbering.new_vertex[triangles[t][k]];
        }
    }
    set_places(graph, positions);
    link_vertices(graph, positions.size());
    link_edges(graph);
    return graph;
}

} // namespace anvil

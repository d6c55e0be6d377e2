#include "engine/distance/window_table.h"

#include "engine/core/parallel_for.h"
#include "engine/distance/fan_table.h"

#include <numbers>

namespace anvil {
namespace {

// Sums of angles are rounded. The shadow of a saddle by less than this is, a thousand sides on, still
// narrower than what windows see of the corners beside them.
constexpr double saddle_slack = 1e-13;

// Radians. Around a corner less wide than this rays come back with their distances unchanged but for
// rounding.
constexpr double thin_angle = 1e-6;

WindowTable::Bend bend_at(const TriangleGraph& graph, uint32_t vertex, double total) {
    const std::span<const uint32_t> sides = graph.sides_leaving(vertex);
    if (sides.empty()) {
        return WindowTable::Bend::never;
    }
    switch (fan_shape(graph, vertex, sides.front()).kind) {
    case FanShape::Kind::closed:
        return total > 2 * std::numbers::pi + saddle_slack ? WindowTable::Bend::saddle
                                                           : WindowTable::Bend::never;
    case FanShape::Kind::open:
        return WindowTable::Bend::boundary;
    default:
        return WindowTable::Bend::anywhere;
    }
}

bool is_thin(const MeasuredTriangle& triangle) {
    const double longest = *std::max_element(triangle.length.begin(), triangle.length.end());
    return triangle.double_area <= thin_angle * longest * longest;
}

uint32_t link_across(const TriangleGraph& graph, uint32_t side) {
    const uint32_t link = graph.across[side];
    if (link == no_index) {
        return no_index;
    }
    const uint32_t other = link >> 1;
    const bool more = graph.across[other] >> 1 != side;
    return 8 * other + (is_thin(measured(graph, other / 3)) ? WindowTable::thin : 0) +
           (more ? WindowTable::more : 0) + ((link & 1) != 0 ? WindowTable::same_way : 0);
}

void set_face(WindowTable& table, const TriangleGraph& graph, uint32_t triangle) {
    WindowTable::Face& face = table.faces[triangle];
    const MeasuredTriangle found = measured(graph, triangle);
    face.length = found.length;
    for (uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side) {
        const PlanePoint along = found.direction_of_apex(side % 3);
        face.along[side % 3] = along;
        face.vertex[side % 3] = graph.from(side);
        face.across[side % 3] = link_across(graph, side);
        table.angle[side] = std::atan2(along.y, along.x);
    }
}

void set_vertex(WindowTable& table, const TriangleGraph& graph, uint32_t vertex) {
    double total = 0;
    for (const uint32_t side : graph.sides_leaving(vertex)) {
        total += table.angle[side];
    }
    table.total[vertex] = total;
    table.bend[vertex] = bend_at(graph, vertex, total);
}

void set_mean_length(WindowTable& table) {
    double sum = 0;
    for (const WindowTable::Face& face : table.faces) {
        sum += face.length[0] + face.length[1] + face.length[2];
    }
    const size_t sides = 3 * table.faces.size();
    table.mean_length = sides > 0 ? sum / static_cast<double>(sides) : 0;
}

void resize(WindowTable& table, const TriangleGraph& graph) {
    table.faces.resize(graph.triangle_count());
    table.angle.resize(graph.corner_vertex.size());
    table.bend.resize(graph.vertex_count());
    table.total.resize(graph.vertex_count());
}

} // namespace

WindowTable make_window_table(const TriangleGraph& graph) {
    WindowTable table;
    table.faces.reserve(with_room(graph.triangle_count()));
    table.angle.reserve(with_room(graph.corner_vertex.size()));
    resize(table, graph);
    parallel_for(graph.triangle_count(), 1 << 13, [&](size_t begin, size_t end) {
        for (size_t t = begin; t < end; ++t) {
            set_face(table, graph, static_cast<uint32_t>(t));
        }
    });
    parallel_for(graph.vertex_count(), 1 << 12, [&](size_t begin, size_t end) {
        for (size_t v = begin; v < end; ++v) {
            set_vertex(table, graph, static_cast<uint32_t>(v));
        }
    });
    set_mean_length(table);
    return table;
}

void update_window_table(WindowTable& table, const TriangleGraph& graph,
                         std::span<const uint32_t> changed_vertices) {
    resize(table, graph);
    for (const uint32_t v : changed_vertices) {
        for (const uint32_t side : graph.sides_leaving(v)) {
            set_face(table, graph, side / 3);
        }
    }
    for (const uint32_t v : changed_vertices) {
        set_vertex(table, graph, v);
    }
    set_mean_length(table);
}

} // namespace anvil

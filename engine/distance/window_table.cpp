#include "engine/distance/window_table.h"

#include "engine/core/parallel_for.h"
#include "engine/distance/fan_table.h"

#include <numbers>

namespace anvil {
namespace {

// Sums of angles are rounded. The shadow of a saddle by less than this is, a thousand sides on, still
// narrower than what windows see of the corners beside them.
constexpr double saddle_slack = 1e-13;

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

} // namespace

WindowTable make_window_table(const TriangleGraph& graph) {
    WindowTable table;
    const size_t sides = graph.corner_vertex.size();
    table.apex.resize(sides);
    table.angle.resize(sides);
    parallel_for(sides, 1 << 14, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s) {
            const auto side = static_cast<uint32_t>(s);
            const double left = graph.side_length[TriangleGraph::previous(side)];
            if (graph.side_length[side] > 0) {
                table.apex[side] =
                    apex_over(graph.side_length[side], left, graph.side_length[TriangleGraph::next(side)]);
            } else {
                table.apex[side] = {left, 0};
            }
            table.angle[side] = left > 0 ? std::atan2(table.apex[side].y, table.apex[side].x) : 0;
        }
    });
    table.bend.resize(graph.vertex_count());
    table.total.resize(graph.vertex_count());
    parallel_for(graph.vertex_count(), 1 << 12, [&](size_t begin, size_t end) {
        for (size_t v = begin; v < end; ++v) {
            const auto vertex = static_cast<uint32_t>(v);
            double total = 0;
            for (const uint32_t side : graph.sides_leaving(vertex)) {
                total += table.angle[side];
            }
            table.total[v] = total;
            table.bend[v] = bend_at(graph, vertex, total);
        }
    });
    double sum = 0;
    for (const double length : graph.side_length) {
        sum += length;
    }
    table.mean_length = sides > 0 ? sum / static_cast<double>(sides) : 0;
    return table;
}

} // namespace anvil

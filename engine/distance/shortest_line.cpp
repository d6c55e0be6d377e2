#include "engine/distance/shortest_line.h"

#include "engine/distance/surface_sleeve.h"

#include <queue>
#include <unordered_map>

namespace anvil {
namespace {

constexpr double snap = 1e-12;

PlacedPoint at_vertex(uint32_t vertex) {
    PlacedPoint point;
    point.vertex = vertex;
    return point;
}

/// Steps down a distance field to its source, across one triangle at a time.
class Descent {
  public:
    Descent(const TriangleGraph& graph, std::span<const double> distances, const PlacedPoint& source)
        : graph_(graph), distances_(distances), source_(source) {}

    /// Empty if it runs in circles, as errors of the field can make it do.
    std::vector<LineStep> from(const PlacedPoint& start) {
        std::vector<LineStep> steps;
        PlacedPoint here = start;
        uint32_t before = no_index;
        while (!arrived_) {
            best_ = infinity;
            for (const uint32_t side : triangles_with(graph_, here)) {
                if (side / 3 != before || here.vertex != no_index) {
                    look_through(side / 3, here);
                }
            }
            if (!(best_ < infinity) || ++visits_[step_.triangle] > most_visits) {
                return {};
            }
            steps.push_back(step_);
            here = step_.end;
            before = step_.triangle;
        }
        return steps;
    }

  private:
    static constexpr int most_visits = 3;

    void look_through(uint32_t triangle, const PlacedPoint& here) {
        const uint32_t first = 3 * triangle;
        const auto at = place_in(graph_, here, first), goal = place_in(graph_, source_, first);
        if (!at) {
            return;
        }
        if (goal) {
            // Nothing is shorter than the straight way, whatever the field says by its errors.
            offer(-infinity, triangle, source_, true);
            return;
        }
        for (uint32_t side = first; side < first + 3; ++side) {
            const bool holds_here =
                here.vertex != no_index
                    ? graph_.from(side) == here.vertex || graph_.to(side) == here.vertex
                    : here.on_base && (graph_.from(side) == graph_.from(here.base)
                                           ? graph_.to(side) == graph_.to(here.base)
                                           : graph_.from(side) == graph_.to(here.base) &&
                                                 graph_.to(side) == graph_.from(here.base));
            if (!holds_here) {
                look_at(side, *place_in(graph_, here, side));
            }
        }
    }

    /// The best place on a side, seen from `at` in its frame: in line with the source where the distances of
    /// its ends put it, or an end.
    void look_at(uint32_t side, const PlanePoint& at) {
        const double length = graph_.length(side);
        const double start = distances_[graph_.from(side)], end = distances_[graph_.to(side)];
        offer(std::hypot(at.x, at.y) + start, side / 3, at_vertex(graph_.from(side)), false);
        offer(std::hypot(at.x - length, at.y) + end, side / 3, at_vertex(graph_.to(side)), false);
        if (!(length > 0) || !(start + end < infinity) || graph_.across[side] == no_index) {
            return;
        }
        const double x = 0.5 * (length + (start - end) * ((start + end) / length));
        const double y = std::sqrt(std::max(0.0, start * start - x * x));
        const double t = (x * at.y + at.x * y) / (y + at.y) / length;
        if (t > snap && t < 1 - snap) {
            PlacedPoint point;
            point.base = side;
            point.weight_end = t;
            point.on_base = true;
            offer(std::hypot(at.x - x, at.y + y), side / 3, point, false);
        }
    }

    void offer(double value, uint32_t triangle, const PlacedPoint& end, bool arrives) {
        if (value < best_) {
            best_ = value;
            step_ = {triangle, end};
            arrived_ = arrives;
        }
    }

    const TriangleGraph& graph_;
    std::span<const double> distances_;
    const PlacedPoint& source_;
    std::unordered_map<uint32_t, int> visits_;
    double best_ = infinity;
    LineStep step_;
    bool arrived_ = false;
};

/// Shortest chain of edges between two vertices over vertices with a distance; empty if there is none.
std::vector<LineStep> edge_chain(const TriangleGraph& graph, std::span<const double> distances, uint32_t from,
                                 uint32_t to) {
    struct Reached {
        double length;
        LineStep step;
        uint32_t before;
    };
    using Waiting = std::pair<double, uint32_t>;
    std::unordered_map<uint32_t, Reached> reached = {{from, {0, {}, no_index}}};
    std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> queue;
    queue.emplace(0.0, from);
    while (!queue.empty() && queue.top().second != to) {
        const auto [length, vertex] = queue.top();
        queue.pop();
        for (const uint32_t side : graph.sides_leaving(vertex)) {
            const uint32_t arriving = TriangleGraph::previous(side);
            for (const auto& [next, edge] :
                 {std::pair{graph.to(side), side}, {graph.from(arriving), arriving}}) {
                const double further = length + graph.length(edge);
                const auto known = reached.find(next);
                if (distances[next] < infinity &&
                    (known == reached.end() || further < known->second.length)) {
                    reached[next] = {further, {side / 3, at_vertex(next)}, vertex};
                    queue.emplace(further, next);
                }
            }
        }
    }
    std::vector<LineStep> steps;
    if (queue.empty()) {
        return steps;
    }
    for (uint32_t vertex = to; vertex != from; vertex = reached[vertex].before) {
        steps.push_back(reached[vertex].step);
    }
    std::reverse(steps.begin(), steps.end());
    return steps;
}

/// A way along edges, for fields that a descent goes astray in.
std::vector<LineStep> way_along_edges(const TriangleGraph& graph, std::span<const double> distances,
                                      const PlacedPoint& from, const PlacedPoint& to) {
    const auto corner_of = [&](const PlacedPoint& point) {
        return point.vertex != no_index ? point.vertex : graph.from(point.base);
    };
    const uint32_t first = corner_of(from), last = corner_of(to);
    if (!(distances[first] < infinity)) {
        return {};
    }
    std::vector<LineStep> steps;
    if (from.vertex == no_index) {
        steps.push_back({from.base / 3, at_vertex(first)});
    }
    const std::vector<LineStep> chain = edge_chain(graph, distances, first, last);
    if (chain.empty() && first != last) {
        return {};
    }
    steps.insert(steps.end(), chain.begin(), chain.end());
    if (to.vertex == no_index) {
        steps.push_back({to.base / 3, to});
    }
    return steps;
}

/// The crossing from one triangle to another at the edge of `side`, which both have.
Crossing crossing_at(const TriangleGraph& graph, uint32_t side, uint32_t from, uint32_t to) {
    Crossing crossing;
    for (const LikeSide& like : sides_of_edge(graph, side)) {
        crossing.out = like.side / 3 == from ? like.side : crossing.out;
        crossing.in = like.side / 3 == to ? like.side : crossing.in;
    }
    return crossing;
}

/// The way from one step to the next; none where only a vertex (or an edge without length) joins them.
std::optional<std::vector<Crossing>> joint(const TriangleGraph& graph, const PlacedPoint& before,
                                           const LineStep& step, const LineStep& next) {
    if (step.triangle == next.triangle) {
        return std::vector<Crossing>{};
    }
    if (step.end.vertex != no_index) {
        const uint32_t vertex = step.end.vertex;
        auto route = fan_route(graph, vertex, direction_to(graph, vertex, step.triangle, before),
                               direction_to(graph, vertex, next.triangle, next.end), infinity);
        return route ? std::optional(std::move(route->crossings)) : std::nullopt;
    }
    if (!(graph.length(step.end.base) > 0)) {
        return std::nullopt;
    }
    return std::vector<Crossing>{crossing_at(graph, step.end.base, step.triangle, next.triangle)};
}

void append_line(const TriangleGraph& graph, Sleeve& sleeve, SurfaceLine& whole) {
    const auto same = [](const PlacedPoint& a, const PlacedPoint& b) {
        return a.vertex != no_index && a.vertex == b.vertex;
    };
    SleeveLine line = straighten(graph, sleeve);
    whole.length += line.length;
    line.points.push_back(sleeve.end);
    for (const PlacedPoint& point : line.points) {
        if (!same(whole.points.back(), point)) {
            whole.points.push_back(point);
        }
    }
}

} // namespace

SurfaceLine shortest_line(const TriangleGraph& graph, std::span<const double> distances,
                          const PlacedPoint& from, const PlacedPoint& to) {
    std::vector<LineStep> steps = Descent(graph, distances, to).from(from);
    if (steps.empty()) {
        steps = way_along_edges(graph, distances, from, to);
    }
    if (steps.empty()) {
        return {};
    }
    SurfaceLine line{{from}, 0};
    Sleeve sleeve{from, to, {steps[0].triangle}, {}};
    for (size_t i = 1; i < steps.size(); ++i) {
        const LineStep& step = steps[i - 1];
        const PlacedPoint& before = i == 1 ? from : steps[i - 2].end;
        const auto crossings = joint(graph, before, step, steps[i]);
        if (!crossings) {
            sleeve.end = step.end;
            append_line(graph, sleeve, line);
            sleeve = {step.end, to, {steps[i].triangle}, {}};
            continue;
        }
        for (const Crossing& crossing : *crossings) {
            sleeve.triangles.push_back(crossing.in / 3);
            sleeve.crossings.push_back(crossing);
        }
    }
    append_line(graph, sleeve, line);
    return line;
}

} // namespace anvil

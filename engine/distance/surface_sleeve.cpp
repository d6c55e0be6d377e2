#include "engine/distance/surface_sleeve.h"

#include <queue>
#include <unordered_map>

namespace anvil {
namespace {

// A bend by less than this makes a line longer by 1e-18 of itself.
constexpr double straight_enough = 1e-9;

/// The side of the triangle that leaves the vertex, which is one of its corners.
uint32_t side_leaving(const TriangleGraph& graph, uint32_t vertex, uint32_t triangle) {
    uint32_t side = 3 * triangle;
    while (side < 3 * triangle + 2 && graph.from(side) != vertex) {
        ++side;
    }
    return side;
}

/// Angle of the triangle at the start of `side`.
double corner_angle(const TriangleGraph& graph, uint32_t side) {
    if (!(graph.length(side) > 0)) {
        return 0;
    }
    const PlanePoint apex = laid_out(graph, side)[2];
    return std::atan2(apex.y, apex.x);
}

/// Finds the least way around a vertex, triangle by triangle.
class FanSearch {
  public:
    FanSearch(const TriangleGraph& graph, uint32_t vertex, const CornerDirection& goal)
        : graph_(graph), vertex_(vertex), goal_(goal) {}

    std::optional<FanRoute> run(const CornerDirection& from, double limit) {
        if (from.triangle == goal_.triangle) {
            return FanRoute{std::abs(from.angle - goal_.angle), {}};
        }
        const uint32_t leaving = side_leaving(graph_, vertex_, from.triangle);
        cross(leaving, from.angle, no_index);
        cross(TriangleGraph::previous(leaving), corner_angle(graph_, leaving) - from.angle, no_index);
        while (!queue_.empty() && queue_.top().angle < limit) {
            const Waiting next = queue_.top();
            queue_.pop();
            if (next.at_goal) {
                return FanRoute{next.angle, crossings_to(next.entry)};
            }
            visit(next);
        }
        return std::nullopt;
    }

  private:
    struct Entry {
        Crossing crossing;
        uint32_t before = no_index;
    };
    struct Waiting {
        double angle = 0;
        uint32_t entry = no_index;
        bool at_goal = false;
        bool operator<(const Waiting& other) const { return angle > other.angle; }
    };

    /// Into every other triangle at the edge of `side`; none unfolds over an edge without length.
    void cross(uint32_t side, double angle, uint32_t before) {
        if (!(graph_.length(side) > 0)) {
            return;
        }
        for (const LikeSide& like : sides_of_edge(graph_, side)) {
            const auto known = least_.find(like.side);
            if (like.side / 3 == side / 3 || (known != least_.end() && known->second <= angle)) {
                continue;
            }
            least_[like.side] = angle;
            entries_.push_back({{side, like.side}, before});
            queue_.push({angle, static_cast<uint32_t>(entries_.size() - 1), false});
        }
    }

    void visit(const Waiting& at) {
        const uint32_t entered = entries_[at.entry].crossing.in;
        const uint32_t leaving = side_leaving(graph_, vertex_, entered / 3);
        const double corner = corner_angle(graph_, leaving);
        if (entered / 3 == goal_.triangle) {
            const double rest = entered == leaving ? goal_.angle : corner - goal_.angle;
            queue_.push({at.angle + std::max(rest, 0.0), at.entry, true});
        }
        cross(entered == leaving ? TriangleGraph::previous(leaving) : leaving, at.angle + corner, at.entry);
    }

    std::vector<Crossing> crossings_to(uint32_t entry) const {
        std::vector<Crossing> crossings;
        for (; entry != no_index; entry = entries_[entry].before) {
            crossings.push_back(entries_[entry].crossing);
        }
        std::reverse(crossings.begin(), crossings.end());
        return crossings;
    }

    const TriangleGraph& graph_;
    uint32_t vertex_;
    CornerDirection goal_;
    std::vector<Entry> entries_;
    std::priority_queue<Waiting> queue_;
    std::unordered_map<uint32_t, double> least_;
};

/// Without triangles that it leaves by the side it came in, nor any twice.
Sleeve without_detours(const Sleeve& sleeve) {
    Sleeve result = sleeve;
    result.triangles = {sleeve.triangles.front()};
    result.crossings.clear();
    std::unordered_map<uint32_t, size_t> place = {{sleeve.triangles.front(), 0}};
    for (Crossing crossing : sleeve.crossings) {
        if (!result.crossings.empty() && result.crossings.back().in == crossing.out) {
            crossing.out = result.crossings.back().out;
            place.erase(result.triangles.back());
            result.triangles.pop_back();
            result.crossings.pop_back();
        }
        const uint32_t triangle = crossing.in / 3;
        const auto earlier = place.find(triangle);
        if (earlier == place.end()) {
            place[triangle] = result.triangles.size();
            result.triangles.push_back(triangle);
            result.crossings.push_back(crossing);
            continue;
        }
        const size_t kept = earlier->second + 1;
        for (size_t i = kept; i < result.triangles.size(); ++i) {
            place.erase(result.triangles[i]);
        }
        result.triangles.resize(kept);
        result.crossings.resize(kept - 1);
    }
    return result;
}

/// A stretch of crossings, all at one vertex, and what takes their place.
struct Detour {
    size_t first = 0, last = 0;
    std::vector<Crossing> crossings;
};

/// The short way around the vertex where crossings `first` to `last` have their points, if there is one.
std::optional<Detour> detour_around(const TriangleGraph& graph, const Sleeve& sleeve, const SleeveLine& line,
                                    size_t first, size_t last) {
    const uint32_t vertex = line.points[first].vertex;
    const PlacedPoint& before = first == 0 ? sleeve.start : line.points[first - 1];
    const PlacedPoint& after = last + 1 == line.points.size() ? sleeve.end : line.points[last + 1];
    if (before.vertex == vertex || after.vertex == vertex) {
        return std::nullopt; // an end of the line, not a bend
    }
    auto route =
        fan_route(graph, vertex, direction_to(graph, vertex, sleeve.triangles[first], before),
                  direction_to(graph, vertex, sleeve.triangles[last + 1], after), M_PI - straight_enough);
    return route ? std::optional<Detour>({first, last, std::move(route->crossings)}) : std::nullopt;
}

/// Bends that do not touch each other, from the last to the first.
std::vector<Detour> detours_of(const TriangleGraph& graph, const Sleeve& sleeve, const SleeveLine& line) {
    std::vector<Detour> detours;
    for (size_t end = line.points.size(); end > 0;) {
        const size_t last = end - 1;
        size_t first = last;
        while (line.points[last].vertex != no_index && first > 0 &&
               line.points[first - 1].vertex == line.points[last].vertex) {
            --first;
        }
        end = first;
        const bool apart = detours.empty() || last + 1 < detours.back().first;
        if (line.points[last].vertex == no_index || !apart) {
            continue;
        }
        if (auto detour = detour_around(graph, sleeve, line, first, last)) {
            detours.push_back(std::move(*detour));
        }
    }
    return detours;
}

Sleeve rerouted(const Sleeve& sleeve, const std::vector<Detour>& detours) {
    Sleeve result{sleeve.start, sleeve.end, {}, {}};
    size_t next = 0;
    const auto keep_until = [&](size_t end) {
        result.crossings.insert(result.crossings.end(), sleeve.crossings.begin() + next,
                                sleeve.crossings.begin() + end);
    };
    for (size_t i = detours.size(); i-- > 0;) {
        keep_until(detours[i].first);
        result.crossings.insert(result.crossings.end(), detours[i].crossings.begin(),
                                detours[i].crossings.end());
        next = detours[i].last + 1;
    }
    keep_until(sleeve.crossings.size());
    result.triangles.push_back(sleeve.triangles.front());
    for (const Crossing& crossing : result.crossings) {
        result.triangles.push_back(crossing.in / 3);
    }
    return without_detours(result);
}

} // namespace

CornerDirection direction_to(const TriangleGraph& graph, uint32_t vertex, uint32_t triangle,
                             const PlacedPoint& point) {
    const uint32_t leaving = side_leaving(graph, vertex, triangle);
    const PlanePoint p = place_in(graph, point, leaving).value_or(PlanePoint{});
    return {triangle, graph.length(leaving) > 0 ? std::atan2(std::max(p.y, 0.0), p.x) : 0};
}

std::optional<FanRoute> fan_route(const TriangleGraph& graph, uint32_t vertex, const CornerDirection& from,
                                  const CornerDirection& to, double limit) {
    return FanSearch(graph, vertex, to).run(from, limit);
}

SleeveLine straighten(const TriangleGraph& graph, Sleeve& sleeve) {
    sleeve = without_detours(sleeve);
    SleeveLine line = line_through(graph, sleeve);
    for (;;) {
        const std::vector<Detour> detours = detours_of(graph, sleeve, line);
        if (detours.empty()) {
            return line;
        }
        Sleeve shorter = rerouted(sleeve, detours);
        SleeveLine next = line_through(graph, shorter);
        // Each round shortens the line, so no sleeve comes twice.
        if (!(next.length < line.length)) {
            return line;
        }
        sleeve = std::move(shorter);
        line = std::move(next);
    }
}

} // namespace anvil

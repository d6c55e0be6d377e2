// Where windows start: at sources and at the vertices that paths bend around.
#include "engine/distance/exact_windows.h"

#include <numbers>

namespace anvil {
namespace {

constexpr double pi = std::numbers::pi;
// Radians. Two ways to a vertex whose lengths differ by rounding arrive in directions that differ by its
// root: a shadow is known no better.
constexpr double wedge_slack = 1e-6;

} // namespace

void ExactWindows::follow_edges(uint32_t vertex) {
    const double offset = distance_[vertex];
    for (const uint32_t side : graph_.sides_leaving(vertex)) {
        const uint32_t next = TriangleGraph::next(side), arriving = TriangleGraph::previous(side);
        const double out = offset + graph_.length(side);
        if (out < distance_[graph_.from(next)] * better) {
            arrive(graph_.from(next), out, next, table_.angle[next]);
        }
        const double back = offset + graph_.length(arriving);
        if (back < distance_[graph_.from(arriving)] * better) {
            arrive(graph_.from(arriving), back, arriving, 0);
        }
    }
}

/// Rays from a vertex at angles [first, last] from `side`, which leaves it, through the opposite side.
void ExactWindows::emit(uint32_t side, double first, double last, double offset) {
    const uint32_t opposite = TriangleGraph::next(side);
    const Exit exit = exit_of(opposite);
    const double length = exit.length;
    const double corner = table_.angle[side];
    const PlanePoint apex = table_.apex(opposite);
    // The frame runs against the opposite side: its start is seen at the corner's angle, its end at 0.
    const auto place = [&](double angle) {
        return graph_.length(side) * std::sin(angle) / std::sin(angle + table_.angle[opposite]);
    };
    const double end = first > 0 ? std::min(length, length - place(first)) : length;
    const double begin = last < corner ? std::max(0.0, length - place(last)) : 0;
    if (end - begin > least_width * length) {
        pass(PointRays{{length - apex.x, apex.y}, offset}, begin, end, exit);
    }
}

/// Rays into the part of the fan that no straight path over this vertex's neighbourhood reaches: at least pi
/// from the ray back on both sides, or on one where the other ends at the boundary.
void ExactWindows::emit_shadow(uint32_t vertex) {
    const Arrival arrival = arrival_[vertex];
    const double offset = distance_[vertex];
    const bool closed = table_.bend[vertex] == WindowTable::Bend::saddle;
    const double first = pi - wedge_slack;
    const double last = closed ? table_.total[vertex] - pi + wedge_slack : infinity;
    // Counterclockwise from the ray back; `at` is the angle of `side`.
    double at = -arrival.angle;
    uint32_t side = arrival.side;
    while (side < TriangleGraph::tangled && at < last) {
        const double corner = table_.angle[side];
        const double from = std::max(first - at, 0.0), to = std::min(last - at, corner);
        if (to > from) {
            emit(side, from, to, offset);
        }
        at += corner;
        side = graph_.twin(TriangleGraph::previous(side));
    }
    if (closed) {
        return;
    }
    // Clockwise: `at` is the angle from the ray back to `side`.
    at = arrival.angle;
    side = arrival.side;
    while (true) {
        const uint32_t twin = graph_.twin(side);
        if (twin >= TriangleGraph::tangled) {
            return;
        }
        side = TriangleGraph::next(twin);
        const double corner = table_.angle[side];
        const double to = std::min(corner, at + corner - first);
        if (to > 0) {
            emit(side, 0, to, offset);
        }
        at += corner;
    }
}

void ExactWindows::bend_at(uint32_t vertex) {
    follow_edges(vertex);
    if (arrival_[vertex].side == no_index || table_.bend[vertex] == WindowTable::Bend::anywhere) {
        for (const uint32_t side : graph_.sides_leaving(vertex)) {
            emit(side, 0, table_.angle[side], distance_[vertex]);
        }
    } else {
        emit_shadow(vertex);
    }
}

/// A source in a triangle sends rays through its sides: each of its three seeds does the side that it leaves
/// along.
void ExactWindows::start_in_triangle(const Seed& seed) {
    if (seed.distance < distance_[seed.vertex]) {
        arrive(seed.vertex, seed.distance, seed.side, seed.angle);
    }
    const double height = seed.distance * std::sin(seed.angle);
    const Exit exit = exit_of(seed.side);
    if (!seed.of_line && height > 0 && exit.length > 0) {
        const PlanePoint source{exit.length - seed.distance * std::cos(seed.angle), height};
        pass(PointRays{source, 0}, 0, exit.length, exit);
    }
}

/// A line sends parallel rays to both sides, through all sides of its triangle.
void ExactWindows::start_line(const Segment& line) {
    const double dx = line.to.x - line.from.x, dy = line.to.y - line.from.y;
    const double length = std::hypot(dx, dy);
    const std::array<PlanePoint, 3> corners = laid_out(graph_, line.base);
    const std::array<uint32_t, 3> sides = {line.base, TriangleGraph::next(line.base),
                                           TriangleGraph::previous(line.base)};
    for (size_t k = 0; k < 3; ++k) {
        const Exit exit = exit_of(sides[k]);
        if (!(exit.length > 0)) {
            continue;
        }
        // Frame of the side turned around, from its end to its start: the triangle lies below, at y > 0.
        const PlanePoint& origin = corners[(k + 1) % 3];
        const PlanePoint u{(corners[k].x - origin.x) / exit.length, (corners[k].y - origin.y) / exit.length};
        const auto in_frame = [&](double x, double y) {
            return PlanePoint{x * u.x + y * u.y, x * u.y - y * u.x};
        };
        const PlanePoint from = in_frame(line.from.x - origin.x, line.from.y - origin.y);
        const PlanePoint to = in_frame(line.to.x - origin.x, line.to.y - origin.y);
        for (const double sign : {1.0, -1.0}) {
            // Where the rays come from; those that leave through this side come from below it.
            const PlanePoint back = in_frame(sign * dy / length, -sign * dx / length);
            if (!(back.y > least_width)) {
                continue;
            }
            const double at_from = from.x - from.y * back.x / back.y, at_to = to.x - to.y * back.x / back.y;
            const double begin = std::max(0.0, std::min(at_from, at_to));
            const double end = std::min(exit.length, std::max(at_from, at_to));
            if (end - begin > least_width * exit.length) {
                // The line itself is at distance 0.
                pass(ParallelRays{back, from.x * back.x + from.y * back.y}, begin, end, exit);
            }
        }
    }
}

void ExactWindows::add(const SourceParts& sources) {
    queue_.rewind();
    std::vector<uint32_t> at_vertices;
    for (const Seed& seed : sources.seeds) {
        if (seed.side == no_index && distance_[seed.vertex] > 0) {
            arrive(seed.vertex, 0, no_index, 0);
            at_vertices.push_back(seed.vertex);
        }
    }
    for (const uint32_t source : at_vertices) {
        bend_at(source);
    }
    for (const Seed& seed : sources.seeds) {
        if (seed.side != no_index) {
            start_in_triangle(seed);
        }
    }
    for (const Segment& line : sources.segments) {
        start_line(line);
    }
}

} // namespace anvil

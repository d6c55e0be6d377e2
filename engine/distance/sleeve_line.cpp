#include "engine/distance/surface_sleeve.h"

namespace anvil {
namespace {

/// An edge between two triangles of the sleeve, laid into the plane, as seen on the way through it.
struct Gate {
    PlanePoint left, right;
    uint32_t left_vertex = no_index, right_vertex = no_index;
    uint32_t side = no_index; ///< of the triangle that is left
    bool starts_right = true; ///< the side runs from right to left
};

struct Layout {
    PlanePoint start, end;
    std::vector<Gate> gates;
};

/// One triangle in the plane. `turn` is 1 if its corners run counterclockwise, else -1.
struct LaidTriangle {
    std::array<PlanePoint, 3> corners;
    double turn = 1;
};

PlanePoint in_frame(const PlanePoint& from, const PlanePoint& to, double turn, const PlanePoint& p) {
    const double dx = to.x - from.x, dy = to.y - from.y;
    const double length = std::hypot(dx, dy);
    const double ex = dx / length, ey = dy / length;
    return {from.x + p.x * ex - turn * p.y * ey, from.y + p.x * ey + turn * p.y * ex};
}

LaidTriangle unfolded(const TriangleGraph& graph, const LaidTriangle& before, const Crossing& crossing) {
    const uint32_t out = crossing.out % 3, in = crossing.in % 3;
    const bool same_way = graph.from(crossing.out) == graph.from(crossing.in);
    LaidTriangle next;
    next.turn = same_way ? -before.turn : before.turn;
    next.corners[in] = before.corners[same_way ? out : (out + 1) % 3];
    next.corners[(in + 1) % 3] = before.corners[same_way ? (out + 1) % 3 : out];
    const PlanePoint apex = laid_out(graph, crossing.in)[2];
    next.corners[(in + 2) % 3] = in_frame(next.corners[in], next.corners[(in + 1) % 3], next.turn, apex);
    return next;
}

/// The point of a triangle in the plane; the triangle holds it.
PlanePoint laid_point(const TriangleGraph& graph, const PlacedPoint& point, uint32_t triangle,
                      const LaidTriangle& laid) {
    const uint32_t first = 3 * triangle;
    for (uint32_t k = 0; k < 3; ++k) {
        if (point.vertex != no_index && graph.corner_vertex[first + k] == point.vertex) {
            return laid.corners[k]; // bit for bit the corner that gates have
        }
    }
    uint32_t base = first;
    // A base of some length, so that its frame has a direction.
    for (uint32_t side = first; side < first + 3; ++side) {
        base = graph.length(side) > graph.length(base) ? side : base;
    }
    if (!(graph.length(base) > 0)) {
        return laid.corners[0];
    }
    const PlanePoint local = place_in(graph, point, base).value_or(PlanePoint{});
    return in_frame(laid.corners[base % 3], laid.corners[(base + 1) % 3], laid.turn, local);
}

Layout layout_of(const TriangleGraph& graph, const Sleeve& sleeve) {
    LaidTriangle laid{laid_out(graph, 3 * sleeve.triangles.front()), 1};
    Layout layout;
    layout.start = laid_point(graph, sleeve.start, sleeve.triangles.front(), laid);
    layout.gates.reserve(sleeve.crossings.size());
    for (const Crossing& crossing : sleeve.crossings) {
        Gate gate;
        gate.side = crossing.out;
        gate.right = laid.corners[crossing.out % 3];
        gate.left = laid.corners[(crossing.out + 1) % 3];
        gate.right_vertex = graph.from(crossing.out);
        gate.left_vertex = graph.to(crossing.out);
        if (laid.turn < 0) {
            std::swap(gate.left, gate.right);
            std::swap(gate.left_vertex, gate.right_vertex);
            gate.starts_right = false;
        }
        layout.gates.push_back(gate);
        laid = unfolded(graph, laid, crossing);
    }
    layout.end = laid_point(graph, sleeve.end, sleeve.triangles.back(), laid);
    return layout;
}

/// Twice the area of the triangle o a b, positive if b lies left of the ray from o to a.
double turn_of(const PlanePoint& o, const PlanePoint& a, const PlanePoint& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Where the line bends: a vertex of a gate.
struct Bend {
    PlanePoint at;
    uint32_t vertex = no_index;
    size_t gate = 0;
};

/// The bends of the shortest line through the gates, in order.
std::vector<Bend> bends_of(const Layout& layout) {
    const size_t count = layout.gates.size();
    std::vector<Bend> bends;
    PlanePoint apex = layout.start;
    Bend left{apex, no_index, 0}, right = left;
    size_t first = 0; // the first gate beyond the apex
    for (size_t i = 0; i <= count; ++i) {
        const Bend next_left = i < count ? Bend{layout.gates[i].left, layout.gates[i].left_vertex, i}
                                         : Bend{layout.end, no_index, i};
        const Bend next_right =
            i < count ? Bend{layout.gates[i].right, layout.gates[i].right_vertex, i} : next_left;
        const auto restart = [&](const Bend& bend) {
            bends.push_back(bend);
            apex = bend.at;
            i = bend.gate;
            first = i + 1;
            left = right = bend;
        };
        if (i == first) {
            left = next_left;
            right = next_right;
            continue;
        }
        if (turn_of(apex, right.at, next_right.at) >= 0) {
            if (turn_of(apex, left.at, next_right.at) > 0) {
                restart(left);
                continue;
            }
            right = next_right;
        }
        if (turn_of(apex, left.at, next_left.at) <= 0) {
            if (turn_of(apex, right.at, next_left.at) < 0) {
                restart(right);
                continue;
            }
            left = next_left;
        }
    }
    return bends;
}

/// Where the line from a to b crosses the gate, from 0 at its right to 1 at its left.
double crossing_of(const Gate& gate, const Bend& a, const Bend& b) {
    for (const Bend* bend : {&a, &b}) {
        if (bend->vertex != no_index &&
            (bend->vertex == gate.right_vertex || bend->vertex == gate.left_vertex)) {
            return bend->vertex == gate.left_vertex ? 1 : 0;
        }
    }
    const double from_right = turn_of(a.at, b.at, gate.right), from_left = turn_of(a.at, b.at, gate.left);
    const double span = from_left - from_right;
    return span > 0 ? std::clamp(-from_right / span, 0.0, 1.0) : 0;
}

PlacedPoint point_on(const Gate& gate, double t) {
    constexpr double snap = 1e-12;
    PlacedPoint point;
    if (t <= snap || t >= 1 - snap) {
        point.vertex = t <= snap ? gate.right_vertex : gate.left_vertex;
        return point;
    }
    point.base = gate.side;
    point.on_base = true;
    point.weight_end = gate.starts_right ? t : 1 - t;
    return point;
}

} // namespace

SleeveLine line_through(const TriangleGraph& graph, const Sleeve& sleeve) {
    const Layout layout = layout_of(graph, sleeve);
    std::vector<Bend> corners = bends_of(layout);
    corners.push_back({layout.end, no_index, layout.gates.size()});
    SleeveLine line;
    line.points.reserve(layout.gates.size());
    Bend from{layout.start, no_index, 0};
    for (const Bend& to : corners) {
        while (line.points.size() < layout.gates.size() && line.points.size() <= to.gate) {
            const Gate& gate = layout.gates[line.points.size()];
            line.points.push_back(point_on(gate, crossing_of(gate, from, to)));
        }
        line.length += std::hypot(to.at.x - from.at.x, to.at.y - from.at.y);
        from = to;
    }
    return line;
}

} // namespace anvil

#include "engine/distance/exact_windows.h"

#include <numbers>

namespace anvil {
namespace {

constexpr double pi = std::numbers::pi;

// A window is only dropped if it is worse by more than rounding, or it and an equal one could drop each
// other.
constexpr double worse = 1 - 1e-12;
constexpr double better = 1 - 1e-15;
constexpr double clearly_worse = 1 + 1e-11;
constexpr double least_width = 1e-13; // of the side: narrower windows are rounding
constexpr double cover_slack = 1e-9;  // of the side: a corner at a window's rim is covered by both neighbours
constexpr double far_behind = 1e7;    // of a line's length
// Radians. Two ways to a vertex whose lengths differ by rounding arrive in directions that differ by its
// root: a shadow is known no better.
constexpr double wedge_slack = 1e-6;

// Real meshes need 5 to 100 windows a vertex; the worst case is quadratic.
constexpr size_t most_windows_a_vertex = 2000;
constexpr size_t most_windows_anyway = 1 << 20;

/// Where the ray from the source through `at` on the base meets the side that leaves the origin along
/// `along`, whose line passes the source at `depth`; infinite where the ray runs beside it.
double hit(double at, const PlanePoint& source, const PlanePoint& along, double depth) {
    const double descent = depth - at * along.y;
    return descent > 0 ? at * source.y / descent : infinity;
}

} // namespace

/// Rays [begin, end] that leave a triangle through `side`, in the frame of the side turned around.
struct ExactWindows::Child {
    uint32_t side;
    double begin, end;
    PlanePoint source;
    double offset;
    PlanePoint corner; ///< of the triangle left, opposite the side
    /// The rim that the rays pass last as seen from that corner: a way from the corner to it crosses them
    /// all. No such rim where the source lies in the triangle.
    enum class Rim { none, begin, end } rim;
};

ExactWindows::ExactWindows(const TriangleGraph& graph, const WindowTable& table)
    : graph_(graph), table_(table), vertices_(graph.vertex_count()), best_(graph.corner_vertex.size()),
      queue_(table.mean_length, 4 * graph.longest_side + table.mean_length) {}

void ExactWindows::push(const Window& window, double key) {
    // The distance to a line is rounded in units of its far centre and may come out below 0.
    key = std::max(key, 0.0);
    queue_.push(key, window);
    ++windows_;
}

void ExactWindows::arrive(uint32_t vertex, double distance, uint32_t side, double angle) {
    Arrival& arrival = vertices_[vertex];
    if (arrival.run != run_) {
        reached_.push_back(vertex);
    }
    arrival = {distance, angle, side, run_};
    if (side != no_index && table_.bend[vertex] != WindowTable::Bend::never) {
        Window bend;
        bend.vertex = vertex;
        bend.offset = distance;
        push(bend, distance);
    }
}

/// Whether paths over the ends of the side (length long) beat every ray of the window.
bool ExactWindows::is_dominated(uint32_t from, uint32_t to, double length, const Window& window) const {
    return known(from) + window.end < window.at_end * worse ||
           known(to) + (length - window.begin) < window.at_begin * worse;
}

void ExactWindows::enter(const Child& child) {
    const uint32_t side = child.side;
    const double length = graph_.side_length[side];
    const PlanePoint& s = child.source;
    Window window;
    window.begin = child.begin;
    window.end = child.end;
    window.source = s;
    window.offset = child.offset;
    window.at_begin = child.offset + std::sqrt((child.begin - s.x) * (child.begin - s.x) + s.y * s.y);
    window.at_end = child.offset + std::sqrt((child.end - s.x) * (child.end - s.x) + s.y * s.y);
    if (is_dominated(graph_.to(side), graph_.from(side), length, window)) {
        return;
    }
    if (child.rim != Child::Rim::none) {
        const bool at_begin = child.rim == Child::Rim::begin;
        const double rim_distance = at_begin ? window.at_begin : window.at_end;
        const double over_corner = known(graph_.apex(side));
        const double dx = child.corner.x - (at_begin ? child.begin : child.end);
        if (over_corner < rim_distance &&
            over_corner + std::sqrt(dx * dx + child.corner.y * child.corner.y) < rim_distance * worse) {
            return;
        }
    }
    const double key = s.x < child.begin ? window.at_begin
                       : s.x > child.end ? window.at_end
                                         : child.offset + s.y;
    // Every other side of the edge, whatever its direction.
    for (uint32_t link = graph_.across[side]; link != no_index && link >> 1 != side;
         link = graph_.across[link >> 1]) {
        const uint32_t other = link >> 1;
        Window entered = window;
        entered.side = other;
        if (graph_.from(other) == graph_.from(side)) {
            entered.begin = length - window.end;
            entered.end = length - window.begin;
            entered.source.x = length - s.x;
            std::swap(entered.at_begin, entered.at_end);
        }
        push(entered, key);
    }
}

void ExactWindows::cross(const Window& w) {
    const uint32_t base = w.side, right = TriangleGraph::next(base), left = TriangleGraph::previous(base);
    const double length = graph_.side_length[base];
    if (is_dominated(graph_.from(base), graph_.to(base), length, w)) {
        return;
    }
    const PlanePoint c = table_.apex[base];
    const PlanePoint s = w.source;
    // All on one line: the corner is met where it lies.
    const double crossing = s.y + c.y > 0 ? (s.x * c.y + c.x * s.y) / (s.y + c.y) : c.x;
    bool goes_left = crossing >= w.begin, goes_right = crossing <= w.end;
    double right_begin = w.begin, left_end = w.end;
    const double slack = cover_slack * length;
    if (crossing >= w.begin - slack && crossing <= w.end + slack) {
        const uint32_t corner = graph_.from(left);
        const double distance = w.offset + std::sqrt((c.x - s.x) * (c.x - s.x) + (c.y + s.y) * (c.y + s.y));
        if (distance < known(corner) * better) {
            const double bx = s.x - c.x, by = -s.y - c.y;
            arrive(corner, distance, left, std::atan2(c.y * bx - c.x * by, -c.x * bx - c.y * by));
        }
        if (goes_left && goes_right) {
            // Of two windows over one corner only the better one splits; the worse keeps its rays on its own
            // side of the better path to the corner, which they cannot usefully cross.
            Best& best = best_[base];
            if (best.run != run_ || distance <= best.distance) {
                best = {distance, crossing, run_};
            } else if (distance > best.distance * clearly_worse) {
                if (crossing < best.crossing) {
                    goes_right = best.crossing < w.end;
                    right_begin = std::max(right_begin, best.crossing);
                } else {
                    goes_left = best.crossing > w.begin;
                    left_end = std::min(left_end, best.crossing);
                }
            }
        }
    }
    if (goes_left && graph_.side_length[left] > 0) {
        const double side = graph_.side_length[left];
        const PlanePoint u{c.x / side, c.y / side};
        // Rays along a side, or behind it by rounding, do not leave through it.
        const double depth = s.x * u.y + s.y * u.x;
        const double begin = w.begin > 0 ? hit(w.begin, s, u, depth) : 0;
        const double end = crossing <= left_end ? side : std::min(side, hit(left_end, s, u, depth));
        if (depth > 0 && end - begin > least_width * side) {
            enter({left,
                   begin,
                   end,
                   {s.x * u.x - s.y * u.y, depth},
                   w.offset,
                   {length * u.x, length * u.y},
                   Child::Rim::begin});
        }
    }
    if (goes_right && graph_.side_length[right] > 0) {
        // The same seen from the other end of the base.
        const double side = graph_.side_length[right];
        const PlanePoint u{(length - c.x) / side, c.y / side};
        const PlanePoint m{length - s.x, s.y};
        const double first = length - w.end, last = length - right_begin;
        const double depth = m.x * u.y + m.y * u.x;
        const double begin = first > 0 ? hit(first, m, u, depth) : 0;
        const double end = crossing >= right_begin ? side : std::min(side, hit(last, m, u, depth));
        if (depth > 0 && end - begin > least_width * side) {
            enter({right,
                   side - end,
                   side - begin,
                   {side - (m.x * u.x - m.y * u.y), depth},
                   w.offset,
                   {side - length * u.x, length * u.y},
                   Child::Rim::end});
        }
    }
}

void ExactWindows::follow_edges(uint32_t vertex) {
    const double offset = known(vertex);
    for (const uint32_t side : graph_.sides_leaving(vertex)) {
        const uint32_t next = TriangleGraph::next(side), arriving = TriangleGraph::previous(side);
        const double out = offset + graph_.side_length[side];
        if (out < known(graph_.from(next)) * better) {
            arrive(graph_.from(next), out, next, table_.angle[next]);
        }
        const double back = offset + graph_.side_length[arriving];
        if (back < known(graph_.from(arriving)) * better) {
            arrive(graph_.from(arriving), back, arriving, 0);
        }
    }
}

/// Rays from a vertex at angles [first, last] from `side`, which leaves it, through the opposite side.
void ExactWindows::emit(uint32_t side, double first, double last, double offset) {
    const uint32_t opposite = TriangleGraph::next(side);
    const double length = graph_.side_length[opposite];
    const double corner = table_.angle[side];
    const PlanePoint at{length - table_.apex[opposite].x, table_.apex[opposite].y};
    // The frame runs against the opposite side: its start is seen at the corner's angle, its end at 0.
    const auto place = [&](double angle) {
        return graph_.side_length[side] * std::sin(angle) / std::sin(angle + table_.angle[opposite]);
    };
    const double end = first > 0 ? std::min(length, length - place(first)) : length;
    const double begin = last < corner ? std::max(0.0, length - place(last)) : 0;
    if (end - begin > least_width * length) {
        enter({opposite, begin, end, at, offset, at, Child::Rim::none});
    }
}

/// Rays into the part of the fan that no straight path over this vertex's neighbourhood reaches: at least pi
/// from the ray back on both sides, or on one where the other ends at the boundary.
void ExactWindows::emit_shadow(uint32_t vertex) {
    const Arrival arrival = vertices_[vertex];
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
            emit(side, from, to, arrival.distance);
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
            emit(side, 0, to, arrival.distance);
        }
        at += corner;
    }
}

void ExactWindows::bend_at(uint32_t vertex) {
    follow_edges(vertex);
    if (vertices_[vertex].side == no_index || table_.bend[vertex] == WindowTable::Bend::anywhere) {
        for (const uint32_t side : graph_.sides_leaving(vertex)) {
            emit(side, 0, table_.angle[side], known(vertex));
        }
    } else {
        emit_shadow(vertex);
    }
}

/// A source in a triangle sends rays through its sides: each of its three seeds does the side that it leaves
/// along.
void ExactWindows::start_in_triangle(const Seed& seed) {
    if (seed.distance < known(seed.vertex)) {
        arrive(seed.vertex, seed.distance, seed.side, seed.angle);
    }
    const double height = seed.distance * std::sin(seed.angle);
    const double length = graph_.side_length[seed.side];
    if (seed.of_line) {
        return;
    }
    if (height > 0 && length > 0) {
        const PlanePoint apex = table_.apex[seed.side];
        const PlanePoint source{length - seed.distance * std::cos(seed.angle), height};
        enter({seed.side, 0, length, source, 0, {length - apex.x, apex.y}, Child::Rim::none});
    }
}

/// A line sends parallel rays to both sides: those of a point so far behind that they bend by some 1e-8 of
/// the line's length, which is also what the far point loses to rounding.
void ExactWindows::start_line(const Segment& line) {
    const double dx = line.to.x - line.from.x, dy = line.to.y - line.from.y;
    const double length = std::hypot(dx, dy);
    const double behind = far_behind * length;
    const std::array<PlanePoint, 3> corners = laid_out(graph_, line.base);
    const std::array<uint32_t, 3> sides = {line.base, TriangleGraph::next(line.base),
                                           TriangleGraph::previous(line.base)};
    for (size_t k = 0; k < 3; ++k) {
        // Frame of the side turned around: from its end to its start, the triangle below at y > 0.
        const PlanePoint& origin = corners[(k + 1) % 3];
        const double side = graph_.side_length[sides[k]];
        if (!(side > 0)) {
            continue;
        }
        const PlanePoint u{(corners[k].x - origin.x) / side, (corners[k].y - origin.y) / side};
        const auto in_frame = [&](double x, double y) {
            return PlanePoint{x * u.x + y * u.y, x * u.y - y * u.x};
        };
        const PlanePoint from = in_frame(line.from.x - origin.x, line.from.y - origin.y);
        const PlanePoint to = in_frame(line.to.x - origin.x, line.to.y - origin.y);
        for (const double sign : {1.0, -1.0}) {
            const PlanePoint n = in_frame(-sign * dy / length, sign * dx / length);
            // Rays that leave through this side go up in its frame's -y.
            if (!(n.y < -1e-9)) {
                continue;
            }
            const double at_from = from.x - from.y * n.x / n.y, at_to = to.x - to.y * n.x / n.y;
            const double begin = std::max(0.0, std::min(at_from, at_to));
            const double end = std::min(side, std::max(at_from, at_to));
            const PlanePoint source{0.5 * (from.x + to.x) - behind * n.x,
                                    0.5 * (from.y + to.y) - behind * n.y};
            if (end - begin > least_width * side) {
                enter({sides[k], begin, end, source, -behind, source, Child::Rim::none});
            }
        }
    }
}

void ExactWindows::clear() {
    if (++run_ == 0) {
        std::fill(vertices_.begin(), vertices_.end(), Arrival{});
        std::fill(best_.begin(), best_.end(), Best{});
        run_ = 1;
    }
    reached_.clear();
    queue_.clear();
    windows_ = 0;
}

void ExactWindows::add(const SourceParts& sources) {
    queue_.rewind();
    std::vector<uint32_t> at_vertices;
    for (const Seed& seed : sources.seeds) {
        if (seed.side == no_index && known(seed.vertex) > 0) {
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

bool ExactWindows::grow(double radius) {
    queue_.open_until(radius);
    while (!queue_.empty()) {
        const Window window = queue_.pop();
        if (window.side != no_index) {
            cross(window);
        } else if (window.offset == vertices_[window.vertex].distance) {
            bend_at(window.vertex);
        }
        if (windows_ > most_windows_anyway + most_windows_a_vertex * reached_.size()) {
            return false;
        }
    }
    return true;
}

} // namespace anvil

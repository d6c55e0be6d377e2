#include "engine/distance/exact_windows.h"

namespace anvil {
namespace {

constexpr std::array<uint32_t, 3> next_corner = {1, 2, 0};
constexpr double clearly_worse = 1 + 1e-11;
constexpr double cover_slack = 1e-9; // of the side: a corner at a window's rim is covered by both neighbours

// Real meshes need 5 to 170 windows a vertex; the worst case is quadratic.
constexpr size_t most_windows_a_vertex = 2000;
constexpr size_t most_windows_anyway = 1 << 20;

} // namespace

ExactWindows::ExactWindows(const TriangleGraph& graph, const WindowTable& table)
    : graph_(graph), table_(table), distance_(graph.vertex_count(), infinity), arrival_(graph.vertex_count()),
      best_(graph.corner_vertex.size()),
      queue_(table.mean_length, 4 * graph.longest_side + table.mean_length) {}

void ExactWindows::arrive(uint32_t vertex, double distance, uint32_t side, double angle) {
    if (distance_[vertex] == infinity) {
        reached_.push_back(vertex);
    }
    distance_[vertex] = distance;
    arrival_[vertex] = {angle, side};
    if (side != no_index && table_.bend[vertex] != WindowTable::Bend::never) {
        queue_.push(distance, {{}, {}, distance, vertex, Kind::bend});
        ++windows_;
    }
}

ExactWindows::Exit ExactWindows::exit_of(uint32_t side) const {
    const WindowTable::Face& face = table_.faces[side / 3];
    const uint32_t k = side % 3;
    return {side, face.across[k], face.vertex[(k + 1) % 3], face.vertex[k], face.length[k], true};
}

/// Faces without area lead rays around a corner of no angle and back, without end and no farther. Of windows
/// that are equal but for rounding only the first enters such a face.
bool ExactWindows::came_before(const Window& window) {
    const auto distance = [](const Window& w, double x) {
        return w.kind == Kind::point ? PointRays{w.source, w.offset}.distance(x)
                                     : ParallelRays{w.source, w.offset}.distance(x);
    };
    std::vector<Window>& earlier = into_thin_[window.place];
    const bool known = std::any_of(earlier.begin(), earlier.end(), [&](const Window& w) {
        const double slack = cover_slack * (window.rim[1] - window.rim[0]);
        return w.kind == window.kind && std::abs(w.offset - window.offset) <= tie * std::abs(w.offset) &&
               w.rim[0] <= window.rim[0] + slack && w.rim[1] >= window.rim[1] - slack &&
               std::all_of(window.rim.begin(), window.rim.end(),
                           [&](double x) { return distance(w, x) <= distance(window, x) * (1 + tie); });
    });
    if (!known) {
        earlier.push_back(window);
    }
    return known;
}

/// Rays [begin, end] through the side that they leave by, unless paths over its ends beat them all.
template <typename Rays>
void ExactWindows::pass(const Rays& rays, double begin, double end, const Exit& exit) {
    if (rays.exceeds(end, distance_[exit.near_vertex] + end) ||
        rays.exceeds(begin, distance_[exit.far_vertex] + (exit.length - begin))) {
        return;
    }
    constexpr Kind kind = std::is_same_v<Rays, PointRays> ? Kind::point : Kind::parallel;
    const double key = std::max(rays.least(begin, end), 0.0);
    const Rays mirrored = rays.mirrored(exit.length);
    // Every other side of the edge, whatever its direction.
    for (uint32_t link = exit.across; link != no_index && link >> 3 != exit.side;) {
        const uint32_t other = link >> 3;
        bool same_way = (link & WindowTable::same_way) != 0;
        if ((link & WindowTable::more) != 0) {
            same_way = graph_.from(other) == graph_.from(exit.side);
        }
        Window window{{begin, end}, rays.source, rays.offset, other, kind};
        if (exit.turned == same_way) {
            window.rim = {exit.length - end, exit.length - begin};
            window.source = mirrored.source;
            window.offset = mirrored.offset;
        }
        if ((link & WindowTable::thin) == 0 || !came_before(window)) {
            queue_.push(key, window);
            ++windows_;
        }
        link = (link & WindowTable::more) != 0 ? table_.faces[other / 3].across[other % 3] : no_index;
    }
}

template void ExactWindows::pass(const PointRays&, double, double, const Exit&);
template void ExactWindows::pass(const ParallelRays&, double, double, const Exit&);

/// The rays [first, last] of a base that leave by the side at its start, at `along` from it; up to its far
/// end if they reach the corner. `over_corner` is the distance of the base's other end.
template <typename Rays>
void ExactWindows::leave(const Rays& rays, double first, double last, bool to_corner, double base,
                         const PlanePoint& along, double over_corner, const Exit& exit) {
    // Rays along a side, or behind it by rounding, do not leave through it.
    const double depth = rays.depth(along);
    if (!(exit.length > 0 && depth > 0)) {
        return;
    }
    const double begin = first > 0 ? rays.hit(first, along, depth) : 0;
    const double end = to_corner ? exit.length : std::min(exit.length, rays.hit(last, along, depth));
    if (!(end - begin > least_width * exit.length)) {
        return;
    }
    const Rays out = rays.turned(along, depth);
    // A way from the base's other end to the rim that the rays pass last crosses them all.
    const double rim = out.distance(begin);
    if (over_corner < rim) {
        const double dx = base * along.x - begin, dy = base * along.y;
        if (over_corner + std::sqrt(dx * dx + dy * dy) < rim * (1 - tie)) {
            return;
        }
    }
    pass(out, begin, end, exit);
}

/// Of two windows over one corner only the better one splits; the worse keeps its rays on its own side of the
/// better path to the corner, which they cannot usefully cross.
ExactWindows::Split ExactWindows::split(const Window& w, double crossing, double distance) {
    Best& best = best_[w.place];
    if (best.run != run_ || distance <= best.distance) {
        best = {distance, crossing, run_};
    } else if (distance > best.distance * clearly_worse) {
        if (crossing < best.crossing) {
            return {w.rim[1], std::max(w.rim[0], best.crossing)};
        }
        return {std::min(w.rim[1], best.crossing), w.rim[0]};
    }
    return {w.rim[1], w.rim[0]};
}

/// Crosses a triangle whose corner no ray comes near, as almost all windows of a dense mesh do. On which side
/// they pass it is anybody's guess, the processor's too: nothing here branches on that.
/// @return false if this is no such window
bool ExactWindows::cross_beside(const Window& w) {
    constexpr std::array<double, 2> zero_one = {0, 1}, sign_of = {1, -1};
    const uint32_t k = w.place % 3, right = next_corner[k], left = next_corner[right];
    const WindowTable::Face& face = table_.faces[w.place / 3];
    const double base = face.length[k], slack = cover_slack * base;
    const double middle = 0.5 * (w.rim[0] + w.rim[1]);
    const double crossing = PointRays{w.source, w.offset}.crossing(
        {face.length[left] * face.along[k].x, face.length[left] * face.along[k].y});
    if (std::abs(crossing - middle) <= w.rim[1] - middle + slack) {
        return false;
    }
    // Rays that leave on the right are seen from the other end of the base.
    const uint32_t mirrored = crossing < middle ? 1 : 0;
    const std::array<uint32_t, 2> near_corner = {k, right}, exit_side = {left, right};
    const uint32_t near = near_corner[mirrored], exit = exit_side[mirrored], over = near_corner[1 - mirrored];
    const double sign = sign_of[mirrored], shift = zero_one[mirrored] * base;
    const PointRays rays{{shift + sign * w.source.x, w.source.y}, w.offset};
    const PlanePoint along = face.along[near];
    const double length = face.length[exit], depth = rays.depth(along);
    const double begin = rays.hit(shift + sign * w.rim[mirrored], along, depth);
    const double end = std::min(length, rays.hit(shift + sign * w.rim[1 - mirrored], along, depth));
    if (!(depth > 0 && end - begin > least_width * length)) {
        return true;
    }
    const PointRays out = rays.turned(along, depth);
    // Of the ways that may beat all rays, over the base's other end and over the ends of the side, the first
    // is almost always the best; the others are tried where a window comes near a corner.
    const double dx = base * along.x - begin, dy = base * along.y;
    const double rim = out.distance(begin);
    const double spare = rim * (1 - tie) - distance_[face.vertex[over]];
    const bool beaten = (spare > 0) & (spare * spare > dx * dx + dy * dy);
    const uint32_t link = face.across[exit];
    if (beaten | (link == no_index)) {
        return true;
    }
    if ((link & (WindowTable::more | WindowTable::thin)) != 0) {
        return false;
    }
    // At most the least distance of the window, without another root.
    const double key = std::max(rim - (end - begin), w.offset);
    const uint32_t flip = mirrored ^ (link & WindowTable::same_way);
    const std::array<double, 2> rims = {begin, end};
    const double sign_out = sign_of[flip], shift_out = zero_one[flip] * length;
    queue_.push(key, {{shift_out + sign_out * rims[flip], shift_out + sign_out * rims[1 - flip]},
                      {shift_out + sign_out * out.source.x, depth},
                      w.offset,
                      link >> 3,
                      Kind::point});
    ++windows_;
    return true;
}

template <typename Rays>
void ExactWindows::cross(const Window& w) {
    const uint32_t k = w.place % 3, right = next_corner[k], left = next_corner[right];
    const WindowTable::Face& face = table_.faces[w.place / 3];
    const Rays rays{w.source, w.offset};
    const double base = face.length[k];
    const uint32_t corner = face.vertex[left];
    const PlanePoint& along = face.along[k];
    const PlanePoint at{face.length[left] * along.x, face.length[left] * along.y};
    const double crossing = rays.crossing(at);
    const bool goes_left = crossing >= w.rim[0], goes_right = crossing <= w.rim[1];
    Split part{w.rim[1], w.rim[0]};
    const double slack = cover_slack * base;
    if (crossing >= w.rim[0] - slack && crossing <= w.rim[1] + slack) {
        const double distance = rays.distance(at);
        if (distance < distance_[corner] * better) {
            const PlanePoint back = rays.back(at);
            arrive(corner, distance, w.place - k + left,
                   std::atan2(at.y * back.x - at.x * back.y, -at.x * back.x - at.y * back.y));
        }
        if (goes_left && goes_right) {
            part = split(w, crossing, distance);
        }
    }
    if (goes_left) {
        leave(rays, w.rim[0], part.left_end, crossing <= part.left_end, base, along,
              distance_[face.vertex[right]],
              {w.place - k + left, face.across[left], face.vertex[k], corner, face.length[left], true});
    }
    if (goes_right) {
        // The same seen from the other end of the base.
        leave(
            rays.mirrored(base), base - w.rim[1], base - part.right_begin, crossing >= part.right_begin, base,
            face.along[right], distance_[face.vertex[k]],
            {w.place - k + right, face.across[right], face.vertex[right], corner, face.length[right], false});
    }
}

void ExactWindows::clear() {
    if (++run_ == 0) {
        std::fill(best_.begin(), best_.end(), Best{});
        run_ = 1;
    }
    for (const uint32_t vertex : reached_) {
        distance_[vertex] = infinity;
    }
    reached_.clear();
    into_thin_.clear();
    queue_.clear();
    windows_ = 0;
}

bool ExactWindows::grow(double radius) {
    queue_.open_until(radius);
    while (!queue_.empty()) {
        const Window window = queue_.pop();
        if (window.kind == Kind::point) {
            if (!cross_beside(window)) {
                cross<PointRays>(window);
            }
        } else if (window.kind == Kind::parallel) {
            cross<ParallelRays>(window);
        } else if (window.offset == distance_[window.place]) {
            bend_at(window.place);
        }
        if (windows_ > most_windows_anyway + most_windows_a_vertex * reached_.size()) {
            return false;
        }
    }
    return true;
}

} // namespace anvil

// The rays of a window: from a point, or parallel ones from a line.
#pragma once

#include "engine/core/types.h"
#include "engine/distance/unfold.h"

namespace anvil {

/// What is worse by less than this, of a distance, may be as good but for rounding.
constexpr double tie = 1e-12;
/// What is better by less than this factor does not count as better.
constexpr double better = 1 - 1e-15;
/// Narrower windows are rounding, in parts of their side.
constexpr double least_width = 1e-13;

/// Rays that come from below a side (it runs along +x from the origin), with their distances. `source` is
/// the point that they come from, y downwards, at `offset` from the true source.
struct PointRays {
    PlanePoint source;
    double offset;

    /// Where the ray to a point above the side crosses it.
    double crossing(const PlanePoint& to) const {
        const double height = source.y + to.y;
        // All on one line: the point is met where it lies.
        return height > 0 ? (source.x * to.y + to.x * source.y) / height : to.x;
    }
    /// How far the source lies beyond the line through the origin along `along`.
    double depth(const PlanePoint& along) const { return source.x * along.y + source.y * along.x; }
    /// Where the ray through `at` on the side meets that line, whose depth is given; infinite where it runs
    /// beside it.
    double hit(double at, const PlanePoint& along, double depth) const {
        const double descent = depth - at * along.y;
        return descent > 0 ? at * source.y / descent : infinity;
    }
    /// The same rays seen from that line.
    PointRays turned(const PlanePoint& along, double depth) const {
        return {{source.x * along.x - source.y * along.y, depth}, offset};
    }
    /// The same rays seen from the other end of the side, mirrored.
    PointRays mirrored(double length) const { return {{length - source.x, source.y}, offset}; }
    double distance(double x) const { return distance({x, 0}); }
    double distance(const PlanePoint& to) const {
        const double dx = to.x - source.x, dy = to.y + source.y;
        return offset + std::sqrt(dx * dx + dy * dy);
    }
    /// Whether distance(x) is above `bound` by more than rounding.
    bool exceeds(double x, double bound) const {
        const double rest = bound * (1 + tie) - offset, dx = x - source.x;
        return (rest < 0) | (rest * rest < dx * dx + source.y * source.y);
    }
    /// The least distance on [begin, end].
    double least(double begin, double end) const {
        // How far the source lies beside them; to clamp it is a branch that nobody can foretell.
        const double beside = 0.5 * (std::abs(source.x - begin) + std::abs(source.x - end) - (end - begin));
        return offset + std::sqrt(beside * beside + source.y * source.y);
    }
    /// From a point above the side along its ray back, y upwards.
    PlanePoint back(const PlanePoint& from) const { return {source.x - from.x, -source.y - from.y}; }
};

/// The same for parallel rays: `source` is the unit direction that they come from, y downwards; `offset` is
/// the distance at the origin.
struct ParallelRays {
    PlanePoint source;
    double offset;

    double crossing(const PlanePoint& to) const { return to.x + source.x * to.y / source.y; }
    double depth(const PlanePoint& along) const { return source.x * along.y + source.y * along.x; }
    double hit(double at, const PlanePoint&, double depth) const { return at * source.y / depth; }
    ParallelRays turned(const PlanePoint& along, double depth) const {
        return {{source.x * along.x - source.y * along.y, depth}, offset};
    }
    ParallelRays mirrored(double length) const { return {{-source.x, source.y}, distance(length)}; }
    double distance(double x) const { return offset - x * source.x; }
    double distance(const PlanePoint& to) const { return offset - to.x * source.x + to.y * source.y; }
    bool exceeds(double x, double bound) const { return bound * (1 + tie) < distance(x); }
    double least(double begin, double end) const { return std::min(distance(begin), distance(end)); }
    PlanePoint back(const PlanePoint&) const { return {source.x, -source.y}; }
};

} // namespace anvil

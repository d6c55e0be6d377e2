// Chains of triangles on a surface, and the shortest line through them.
#pragma once

#include "engine/distance/source_seeds.h"

#include <optional>
#include <span>
#include <vector>

namespace anvil {

/// The next place of a line and the triangle (of the graph) that leads there from the place before.
struct LineStep {
    uint32_t triangle = no_index;
    PlacedPoint end;
};

/// From one triangle of a sleeve to the next: two sides of one edge.
struct Crossing {
    uint32_t out = no_index; ///< of the triangle that is left
    uint32_t in = no_index;  ///< of the one that is entered
};

/// A way around a vertex from one of its triangles to another.
struct FanRoute {
    double angle = 0;
    std::vector<Crossing> crossings; ///< none: it stays in the triangle
};

/// A direction at a vertex: a triangle there, and the angle from its side that leaves the vertex.
struct CornerDirection {
    uint32_t triangle = no_index;
    double angle = 0;
};

/// The least angle at `vertex` between two directions, over any edges with any number of triangles; none if
/// it is not below `limit` or no chain of triangles leads there.
std::optional<FanRoute> fan_route(const TriangleGraph& graph, uint32_t vertex, const CornerDirection& from,
                                  const CornerDirection& to, double limit);

/// The direction at `vertex`, a corner of `triangle`, to a point that the triangle holds.
CornerDirection direction_to(const TriangleGraph& graph, uint32_t vertex, uint32_t triangle,
                             const PlacedPoint& point);

/// Triangles that share an edge each with the next, and a line through them.
struct Sleeve {
    PlacedPoint start, end;          ///< in the first and the last triangle
    std::vector<uint32_t> triangles; ///< at least one
    std::vector<Crossing> crossings; ///< one less; no edge of length 0
};

/// A shortest line through a sleeve.
struct SleeveLine {
    double length = 0;               ///< units of the graph
    std::vector<PlacedPoint> points; ///< where it meets the edge of each crossing
};

/// Triangles are unfolded into the plane one by one; there a funnel finds the line (Lee & Preparata 1984).
SleeveLine line_through(const TriangleGraph& graph, const Sleeve& sleeve);

/// Moves a sleeve over the vertices that its line bends around on the short side, until there is none: the
/// line is then a geodesic (an edge-wise version of the flips of Sharp & Crane 2020).
SleeveLine straighten(const TriangleGraph& graph, Sleeve& sleeve);

} // namespace anvil

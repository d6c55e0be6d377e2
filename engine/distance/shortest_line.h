// Shortest lines along a surface.
#pragma once

#include "engine/distance/source_seeds.h"

#include <span>
#include <vector>

namespace anvil {

/// Both ends of a line and each edge or vertex between that it meets, so that each two neighbours lie in one
/// triangle (or on its rim).
struct SurfaceLine {
    std::vector<PlacedPoint> points; ///< empty if there is none
    double length = infinity;        ///< units of the graph
};

/// A geodesic from `from` to `to`. `distances`: of the graph's vertices from `to` (units of
/// the graph, infinite where unknown); they tell which way around an obstacle is the shorter one, and the
/// line is then straightened, so that their errors do not bend it. None if no way leads there.
SurfaceLine shortest_line(const TriangleGraph& graph, std::span<const double> distances,
                          const PlacedPoint& from, const PlacedPoint& to);

} // namespace anvil

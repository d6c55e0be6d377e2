// Sources of any kind turned into start values at vertices.
#pragma once

#include "engine/distance/triangle_graph.h"
#include "engine/mesh/surface_point.h"

namespace anvil {

/// A vertex (of the graph) that sees source number `label` in a straight line, at `distance` (units of the
/// graph).
struct Seed {
    uint32_t vertex = 0;
    uint32_t label = 0;
    double distance = 0;
    uint32_t side =
        no_index;     ///< leaves the vertex, in a triangle that holds the source; none: it is the vertex
    double angle = 0; ///< from the side to the source, within that triangle
};

/// Seeds of all sources, label = index into `sources`: the vertex itself, or the corners of all triangles
/// that hold the point. Weights within 1e-12 of 0 count as 0.
/// @throws InputError if a source is not a point of this surface.
std::vector<Seed> seed_sources(const TriangleGraph& graph, std::span<const SurfacePoint> sources);

} // namespace anvil

// Sources that are lines: polylines along the surface and the edges of whole faces.
#pragma once

#include "engine/distance/source_seeds.h"
#include "engine/distance/unfold.h"

namespace anvil {

/// A straight piece of a source inside one triangle, in the frame of the side `base` (start at the origin,
/// end on +x, the triangle at y >= 0).
struct Segment {
    uint32_t base = no_index;
    PlanePoint from, to;
};

/// All that a set of sources comes to.
struct SourceParts {
    std::vector<Seed> seeds;
    std::vector<Segment> segments;
};

/// Seeds and segments of points, polylines and whole triangles. Each point, polyline and triangle has a label
/// of its own. The points of a polyline that follow each other lie in one triangle (or on its rim).
/// @throws InputError if a point is none of this surface, or two neighbours of a polyline share no triangle.
SourceParts source_parts(const TriangleGraph& graph, std::span<const SurfacePoint> points,
                         std::span<const std::vector<SurfacePoint>> polylines,
                         std::span<const uint32_t> triangles);

} // namespace anvil

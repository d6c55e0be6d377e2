// The same surface cut into better triangles: edges flipped inside of it until they are Delaunay.
#pragma once

#include "engine/distance/triangle_graph.h"

namespace anvil {

/// Directions at a vertex are angles counterclockwise from a first side, summed over its corners. Flips may
/// take that side away; this says which side stands for it and at which direction it lies.
struct DirectionOrigin {
    uint32_t side = no_index; ///< leaves the vertex; no_index at isolated vertices
    float direction = 0;
};

/// Flips edges of `graph` by their lengths alone until the angles opposite each flippable edge sum to at most
/// pi. Vertices and distances on the surface stay; edges with other than two like-oriented triangles stay.
/// Slots of triangles are used anew, so sides keep no meaning; edges may become parallel, never loops.
/// @return one origin per vertex, whose direction 0 is the vertex's first leaving side before the flips.
std::vector<DirectionOrigin> flip_to_delaunay(TriangleGraph& graph);

} // namespace anvil

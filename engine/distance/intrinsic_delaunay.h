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

/// A surface by its lengths alone. Edges may be parallel.
struct IntrinsicGraph : TriangleLinks {
    std::vector<double> side_length; ///< 3 per triangle
};

/// The same triangles, by their lengths.
IntrinsicGraph by_lengths(const TriangleGraph& graph);

struct IntrinsicDelaunay {
    /// One per vertex; direction 0 is the vertex's first leaving side before the flips.
    std::vector<DirectionOrigin> origins;
    /// Per triangle before the flips, bit k: its side k was flipped away, for ever or for a time. Triangles
    /// that are joined by such sides hold the new triangles that lie in them whole, and no others.
    std::vector<uint8_t> flipped;
};

/// Flips edges of `graph` by their lengths alone until the angles opposite each flippable edge sum to at most
/// pi. Vertices and distances on the surface stay; edges with other than two like-oriented triangles stay.
/// Slots of triangles are used anew, so sides keep no meaning; edges may become parallel, never loops.
/// The same triangles give the same flips wherever they lie in a surface, if their slots keep their order.
IntrinsicDelaunay flip_to_delaunay(IntrinsicGraph& graph);

} // namespace anvil

// The polygons' edges, grouped: what health, normals and other adjacency questions start from.
#pragma once

#include "engine/mesh/mesh.h"

namespace anvil {

/// One polygon's use of an edge. Corner c runs from its vertex to that of the polygon's next corner.
struct EdgeUse {
    uint32_t high;        ///< the edge's higher vertex
    uint32_t low_corner;  ///< the polygon's corner at the lower vertex
    uint32_t high_corner; ///< and at the higher one
    bool forward;         ///< the polygon runs from the lower to the higher vertex
};

/// Uses of all edges, those of one lower vertex together, sorted by the higher one: the uses of one edge are
/// neighbours. Edges from a vertex to itself are left out.
struct EdgeList {
    std::vector<uint32_t> begin; ///< n + 1 entries: uses of lower vertex v are [begin[v], begin[v + 1])
    std::vector<EdgeUse> uses;
};

EdgeList list_edges(const Mesh& mesh);

} // namespace anvil

// What a test asks of a triangle mesh's shape, counted without the engine's own help.
#pragma once

#include "engine/mesh/mesh.h"

namespace anvil::test {

struct MeshFacts {
    size_t boundary_edges = 0;       ///< edges that a triangle follows and none comes back
    size_t non_manifold_edges = 0;   ///< repetitions of an edge in the same direction
    size_t bow_tie_vertices = 0;     ///< vertices whose triangles do not form one fan
    size_t isolated_vertices = 0;    ///< vertices without a triangle
    size_t degenerate_triangles = 0; ///< triangles that name a vertex twice or have no area
    size_t components = 0;           ///< pieces connected by edges or vertices, isolated vertices apart
    long euler = 0;                  ///< vertices - edges + triangles
    double volume = 0;               ///< enclosed; positive if oriented outwards
    double min_angle = 0;            ///< degrees

    bool closed_manifold() const {
        return boundary_edges + non_manifold_edges + bow_tie_vertices + isolated_vertices +
                   degenerate_triangles ==
               0;
    }
};

MeshFacts facts_of(const Mesh& mesh);

} // namespace anvil::test

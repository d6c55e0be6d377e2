// Better angles without another vertex: new vertices slide along the edges that they were put on.
#pragma once

#include "engine/refine/adaptive_refinement.h"

namespace anvil {

struct RelaxRules {
    std::vector<char> fixed; ///< per vertex: not 0 where a new one stays, on creases; old ones do anyway
    double tolerance = 0;    ///< no edge that is moved has a larger error then
    EdgeCriterion* criterion = nullptr;
};

/// Moves new vertices that are no vertex's parent between their parents, where that makes the least angle
/// around them larger: `place` of their parents, their positions and their distances. Since both parents lie
/// in one triangle of the mesh before, so does the vertex, and the surface stays what it is.
/// @return the largest error of an edge that was moved.
double relax_vertices(RefineState& state, std::span<const EdgeMesh::Face> faces, const RelaxRules& rules);

} // namespace anvil

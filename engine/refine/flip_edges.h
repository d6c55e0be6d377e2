// Better angles without another vertex: edges inside divided triangles joined the other way.
#pragma once

#include "engine/refine/edge_error.h"
#include "engine/refine/edge_mesh.h"

#include <functional>

namespace anvil {

struct FlipRules {
    std::function<bool(uint32_t a, uint32_t b)> is_fixed; ///< edges that stay: creases
    /// Errors of edges that would be new.
    std::function<std::vector<double>(std::span<const EdgeSpan>)> errors;
    double tolerance = 0; ///< no new edge has a larger error
};

/// Flips edges between two parts of one triangle (`root`) where that makes the least angle of the two larger.
/// The surface stays what it is. The flipped faces' `edges` are no_index.
/// @return the largest error of an edge that is new.
double flip_edges(std::vector<EdgeMesh::Face>& faces, std::span<const Vec3> positions,
                  const FlipRules& rules);

} // namespace anvil

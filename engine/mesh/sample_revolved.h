// Surfaces of revolution around the y axis from rings of freely chosen vertex counts.
#pragma once

#include "engine/mesh/mesh.h"

namespace anvil::sample {

/// Vertices on a circle around the y axis; radius 0 is a single vertex.
struct Ring {
    double radius = 0;
    double height = 0;
};

/// Closed mesh of the rings from the lowest pole to the highest: first and last have radius 0, the others do
/// not. Each ring's share of about `vertices` is proportional to its radius, at least 3; the total is met to
/// 5 %, if need be by uneven rings. Neighbouring rings are turned against each other by half an edge.
/// `vertices` must be at least 2 + 3 (rings - 2).
Mesh revolve(const std::vector<Ring>& rings, size_t vertices);

} // namespace anvil::sample

// Seeds of sources on the input triangles, carried over to the fans that fronts march on.
#pragma once

#include "engine/distance/source_seeds.h"
#include "engine/distance/vertex_fronts.h"

namespace anvil {

/// Fronts at the corners of the triangles that hold each source, and at those of the flipped triangle that
/// holds it. `graph` is the input surface, `table` was made from the flipped one.
std::vector<FrontSeed> front_seeds(const TriangleGraph& graph, const FanTable& table,
                                   std::span<const Seed> seeds);

} // namespace anvil

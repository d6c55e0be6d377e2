// An occluder's surface for people to look at.
#pragma once

#include "engine/occluder/shape_nodes.h"
#include "engine/occluder/solid.h"

namespace anvil {

/// In the shape's own space: that of its file, or polygonized with `cells` along its longest side; of a plane
/// a square somewhat wider than `scene` (world, seen from `place`); nothing of other unbounded shapes.
/// @throws InputError if a file cannot be read.
Mesh shown_surface(const OccluderShape& shape, const Placement& place, const Box& scene,
                   const SolidSource& source, int cells);

} // namespace anvil

// A recipe's shape as the kernels' postfix program.
#pragma once

#include "engine/edit/recipe.h"
#include "engine/occluder/kernel_types.h"

#include <array>
#include <vector>

namespace anvil {

/// A rigid transform with uniform scale: x -> origin + scale (axes[0] x.x + axes[1] x.y + axes[2] x.z).
struct Placement {
    std::array<Vec3, 3> axes{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    Vec3 origin{0};
    double scale = 1;
};

Placement placement(const Transform& transform);

/// inner first, then outer.
Placement composed(const Placement& outer, const Placement& inner);

/// Nodes of a shape in postfix order, leaves placed in the occluder's space.
/// @throws InputError if more than MAX_SHAPE_STACK operands wait at once.
std::vector<kernel::f64::ShapeNode> shape_nodes(const OccluderShape& shape);

} // namespace anvil

// Normals of an input's surface on the CPU.
#pragma once

#include "engine/deform/deform_input.h"

#include <span>
#include <vector>

namespace anvil {

/// Normals of `input.fans` with the points where `results` take them, in double, on all cores; the vectors
/// are given to be used again.
void find_fan_normals(const DeformInput& input, std::span<const PointResult> results, std::vector<Vec3>& ends,
                      std::vector<Vec3>& normals);

} // namespace anvil

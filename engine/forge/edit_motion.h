// Where an edit's handles go: the constraint system over the region's weights.
#pragma once

#include "engine/core/log.h"
#include "engine/deform/deform_input.h"
#include "engine/edit/recipe.h"
#include "engine/forge/edit_region.h"
#include "engine/solve/constraint_solver.h"

#include <string>

namespace anvil {

struct EditMotion {
    DeformMotion motion;
    Solution solution;
    std::vector<double> target_errors; ///< k, world units: how far each handle ends from its target, or is
                                       ///< from its path at worst
};

/// Solves A X = D (eq. 4-5, 9) for the partial displacements or angles. A(i,j) = sum_v b_v alpha_j(v) over
/// the vertices that carry handle i. Several paths share normalized arc length; the motion has a sample at
/// each of their corners. Rotations of handles inside faces are corrected by Newton steps, so that
/// the point on the moved face stands at the asked angle. `place` is "edits[i]"; `origin`: local origin;
/// where the paper's rule acts, the default is 32 equal steps. Where occluders move, the motion has a sample
/// at each of their poses too; without handles only these.
/// @throws InputError if a target is out of reach and the edit does not ask for least squares.
EditMotion find_motion(const Edit& edit, const EditRegion& region, std::span<const Vec3> positions,
                       const Vec3& origin, const std::string& place, const OccluderSet& occluders, Log& log);

/// What find_motion() will give for the edit, without its targets: for Backend::warm().
DeformMotion foreseen_motion(const Edit& edit, const OccluderSet& occluders);

} // namespace anvil

// An edit on both sides of its mirror plane.
#pragma once

#include "engine/edit/recipe.h"
#include "engine/forge/surface_state.h"

#include <string>

namespace anvil {

/// The same edit without `mirror`, everything that it says of one side said of the other one too: handles
/// with their targets, radii, shapes and anchors, and pinned points, each at the surface point nearest to its
/// image. The given handles come first. A handle nearer to the plane than Mirror::merge stays one and moves
/// along the plane; one that has another handle at its image stays as it is. Occluders are not repeated.
/// `diagonal`: of the mesh; `place` is "edits[i]".
/// @throws InputError for addresses that are wrong, and rotations whose axis is not its own image.
Edit on_both_sides(const Edit& edit, const std::string& place, SurfaceState& surface, double diagonal);

} // namespace anvil

// The anchors of a handle on the mesh.
#pragma once

#include "engine/edit/recipe.h"
#include "engine/forge/surface_state.h"

#include <string>

namespace anvil {

/// What distances are measured from, one entry an anchor, each place once: a point, line or face that is
/// given again adds nothing. `smooth_rounds` is of the copy that lines are traced on; `place` is
/// "edits[0].anchors[1]". @throws InputError for addresses that the mesh does not have, and for lines between
/// components.
std::vector<DistanceSources> resolve_anchors(const std::vector<AnchorAddress>& anchors,
                                             uint32_t smooth_rounds, const std::string& place,
                                             SurfaceState& surface);

} // namespace anvil

// How finely an edit cuts the mesh, as controls of the edit under way and of past ones.
#pragma once

#include "engine/edit/recipe.h"
#include "engine/forge/report.h"

namespace anvil {

/// Whether something was changed; `size`: of the scene, world.
bool refine_controls(std::optional<Refine>& refine, double size);

/// What refinement did, or would do to a mesh of `vertices` then.
void show_refinement(const RefineSummary& summary, size_t vertices);

} // namespace anvil

// One edit as a stage: the surface before it in, the surface after it out.
#pragma once

#include "engine/core/log.h"
#include "engine/core/progress.h"
#include "engine/deform/backend.h"
#include "engine/edit/recipe.h"
#include "engine/forge/edit_occluders.h"
#include "engine/forge/kept_solvers.h"
#include "engine/forge/surface_version.h"

#include <string>

namespace anvil {

/// What is built once and serves all edits of a mesh.
struct EditTools {
    const EditOccluders& occluders;
    KeptSolvers& solvers; ///< of the file's mesh
    Backend& backend;
    Log& log;
    Progress& progress;
};

/// The surface after the edit; `place` ("edits[2]") begins messages. It depends on the surface before, the
/// edit, its occluders and the back end alone: the same again gives the same, bit for bit.
/// @throws InputError, DeviceError, Cancelled as forge() does.
SurfaceVersion apply_edit(SurfaceVersion before, const Edit& edit, const std::string& place,
                          const EditTools& tools);

} // namespace anvil

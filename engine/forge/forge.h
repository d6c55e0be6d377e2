// The whole path of an edit record: mesh and recipe in, deformed mesh and report out.
#pragma once

#include "engine/core/file_cache.h"
#include "engine/core/log.h"
#include "engine/core/progress.h"
#include "engine/deform/backend.h"
#include "engine/edit/recipe.h"
#include "engine/forge/report.h"
#include "engine/mesh/mesh.h"
#include "engine/refine/refined_mesh.h"

#include <memory>
#include <vector>

namespace anvil {

/// Vectors over vertices cover those of `refined` where it is set, the mesh's own else.
struct ForgeResult {
    std::vector<Vec3>
        positions;           ///< of the mesh's vertices after all edits; unmoved ones bit for bit as before
    std::vector<bool> moved; ///< vertices that any edit moved
    std::vector<float>
        weights; ///< largest |phi| of any handle of any edit at each vertex, at most 1: the region
    std::vector<bool> touching; ///< vertices that touch an occluder after the last edit that has any
    /// The mesh with the vertices that refinement added, old ones first, as it is before any edit; absent if
    /// none were added.
    std::shared_ptr<const Mesh> refined;
    std::vector<VertexParents> parents; ///< of the added vertices
    ForgeReport report;                 ///< its load and write seconds are the caller's to fill
};

/// Applies the recipe's edits in order to the mesh, each evaluated on what the one before left; the recipe's
/// mesh path is not read. Baked fields are kept in `cache`, if there is one. Warnings go to the log and into
/// the report.
/// @throws InputError naming the place in the recipe (unreachable targets, indices out of range, unbounded
/// bakes),
///         DeviceError, Cancelled.
ForgeResult forge(const Mesh& mesh, const Recipe& recipe, Backend& backend, Log& log, Progress& progress,
                  const FileCache* cache = nullptr);

} // namespace anvil

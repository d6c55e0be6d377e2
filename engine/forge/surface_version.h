// A mesh between two edits, as a value.
#pragma once

#include "engine/forge/edit_input.h"
#include "engine/forge/report.h"
#include "engine/mesh/mesh.h"
#include "engine/refine/refined_places.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace anvil {

/// What the edits so far made of a file's mesh. Versions share the meshes, which never change; vectors over
/// vertices cover those of `mesh`.
struct SurfaceVersion {
    std::shared_ptr<const Mesh> file; ///< before any edit
    std::shared_ptr<const Mesh> mesh; ///< as refinement left it, its positions those before any edit
    std::shared_ptr<const RefinementHistory> history; ///< from `file` to `mesh`
    LocalFrame frame;                                 ///< of the file's mesh
    std::vector<Vec3> positions;                      ///< unmoved ones bit for bit as before
    std::vector<bool> moved;                          ///< vertices that any edit moved
    std::vector<float> weights;   ///< largest |phi| of any handle of any edit, at most 1: the region
    std::vector<bool> touching;   ///< vertices that touch an occluder after the last edit that has any
    std::optional<double> volume; ///< of closed meshes
    uint64_t number = 0;          ///< of the surface, for KeptSolvers

    // Of the edit that made it; as new before any.
    EditReport report;
    StageSeconds seconds;
    std::vector<std::string> warnings;

    bool refined() const { return mesh != file; }
};

/// The file's mesh before any edit.
SurfaceVersion first_version(std::shared_ptr<const Mesh> file);

/// What a version takes in memory beside the meshes, and what its mesh takes with its history.
size_t own_bytes(const SurfaceVersion& version);
size_t mesh_bytes(const SurfaceVersion& version);

} // namespace anvil

// OpenVDB level sets: what Houdini and Blender hand over as a solid, and what `anvil bake` hands to them.
#pragma once

#include "engine/core/log.h"
#include "engine/core/progress.h"
#include "engine/mesh/mesh.h"
#include "engine/occluder/exact_distance.h"

#include <filesystem>
#include <string>

namespace anvil {

/// The zero set of a level set as quads, outwards oriented, in the grid's world space; one vertex a cell that
/// the surface crosses. A narrow band is enough; its values need not be distances. Any rigid transform with
/// cubic voxels.
/// @param grid its name; empty: the file's only level set
/// @throws InputError if the file cannot be read or is no VDB file, the name is unknown or needed (the
/// message lists the names), the grid holds no scalars, is a fog volume, is empty, has no surface, or has
/// voxels that are no cubes.
Mesh read_level_set(const std::filesystem::path& file, const std::string& grid, Log& log);

/// Writes the solid as level set "surface" (class level set, float, world units): true distances within 3
/// voxels of the surface, +-3 voxels elsewhere. Voxel centres lie at whole multiples of `voxel`, > 0.
/// @param solid exact and bounded, since blocks far from its surface are left out by its distance
/// @throws InputError if the solid is unbounded or has no extent or no voxel; WriteError; Cancelled;
/// DeviceError.
void write_level_set(const std::filesystem::path& file, const ExactDistance& solid, double voxel,
                     Progress& progress, SearchDevice* device = nullptr);

} // namespace anvil

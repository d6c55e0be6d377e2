// A recipe's shape as a solid: its exact distance and its surface, meshes included.
#pragma once

#include "engine/core/log.h"
#include "engine/edit/recipe.h"
#include "engine/mesh/mesh.h"
#include "engine/occluder/exact_distance.h"

#include <filesystem>
#include <memory>

namespace anvil {

/// Where the shape's mesh files lie, and who hears what is wrong with them (nobody if nullptr).
struct SolidSource {
    std::filesystem::path folder;
    Log* log = nullptr;
};

/// Signed distance of the shape in its own space: exact for one primitive or mesh; for Boolean shapes exact
/// in sign and zero set, elsewhere a bound (see redistanced()). @throws InputError if a mesh file cannot be
/// read.
std::shared_ptr<const ExactDistance> solid_distance(const OccluderShape& shape, const SolidSource& source);

/// The surface of a bounded shape as a mesh: a mesh shape's own, else polygonized with `cells` along its
/// longest side. @throws InputError if a mesh file cannot be read.
Mesh solid_surface(const OccluderShape& shape, const SolidSource& source, int cells);

} // namespace anvil

// A recipe's shape as a solid: its exact distance and its surface, files included.
#pragma once

#include "engine/core/log.h"
#include "engine/edit/recipe.h"
#include "engine/mesh/mesh.h"
#include "engine/occluder/exact_distance.h"

#include <filesystem>
#include <memory>

namespace anvil {

/// Where the shape's files lie, and who hears what is wrong with them (nobody if nullptr).
struct SolidSource {
    std::filesystem::path folder;
    Log* log = nullptr;
};

/// Signed distance of the shape in its own space: exact for one primitive or mesh; for Boolean shapes exact
/// in sign and zero set, elsewhere a bound (see redistanced()). @throws InputError if a file cannot be
/// read.
std::shared_ptr<const ExactDistance> solid_distance(const OccluderShape& shape, const SolidSource& source);

/// solid_distance(), re-distanced where the shape is Boolean, from a polygonization with `cells` along its
/// longest side. @throws InputError if a file cannot be read, or a Boolean shape is unbounded or empty.
std::shared_ptr<const ExactDistance> true_distance(const OccluderShape& shape, const SolidSource& source,
                                                   int cells);

/// A solid at its place.
std::shared_ptr<const ExactDistance> placed(std::shared_ptr<const ExactDistance> solid,
                                            const Transform& transform);

/// The surface of a bounded shape as a mesh: that of its file, else polygonized with `cells` along its
/// longest side. @throws InputError if a file cannot be read.
Mesh solid_surface(const OccluderShape& shape, const SolidSource& source, int cells);

} // namespace anvil

// Any triangle mesh as a solid.
#pragma once

#include "engine/core/log.h"
#include "engine/mesh/mesh.h"
#include "engine/occluder/exact_distance.h"

#include <memory>

namespace anvil {

/// Exact distance to the mesh's surface; inside where the generalized winding number exceeds 1/2 in
/// magnitude, so that open, self-intersecting, non-manifold, inverted and partly flipped meshes have the
/// inside that a person sees; faces that are flipped among their neighbours are turned back first, and none
/// counts twice. Nothing is inside beyond the mesh's bounds. `log`, if any, hears what is wrong with the mesh
/// as a solid. @throws InputError if it has no triangle.
std::shared_ptr<const ExactDistance> mesh_distance(const Mesh& mesh, Log* log = nullptr);

} // namespace anvil

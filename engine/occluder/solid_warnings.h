// What is wrong with a mesh as a solid, in words.
#pragma once

#include "engine/core/log.h"
#include "engine/mesh/mesh.h"

namespace anvil {

/// Adds a warning for each of: holes, faces pointing inwards, faces that pass through others, each with what
/// becomes of it; flipped faces and non-manifold edges are the mesh's own warnings (see warn_about()).
/// `crossing_triangles`: how many pass through others.
void warn_about_solid(const Mesh& mesh, size_t crossing_triangles, Log& log);

} // namespace anvil

// From a point on a file's mesh to how a recipe writes it.
#pragma once

#include "engine/edit/surface_address.h"
#include "engine/mesh/surface_point.h"

namespace anvil {

/// The polygon whose triangle the point lies in. @pre the point has a triangle of the mesh.
FaceAddress face_address(const Mesh& mesh, const SurfacePoint& point);

} // namespace anvil

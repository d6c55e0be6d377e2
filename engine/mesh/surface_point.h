// A place on the triangulated surface.
#pragma once

#include "engine/core/types.h"

namespace anvil {

/// A point of a mesh by its triangle (index into Mesh::triangles) and the weights of the triangle's corners:
/// each >= 0, sum 1. A point that is a vertex has one weight of 1. An isolated vertex lies on no triangle:
/// there `triangle` is no_index and `vertex` names it; `vertex` may be left unset everywhere else.
struct SurfacePoint {
    uint32_t triangle = no_index;
    Vec3 barycentric{0.0};
    uint32_t vertex = no_index;
};

} // namespace anvil

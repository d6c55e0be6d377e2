// Triangles of even size and shape on a closed surface that is given implicitly.
#pragma once

#include "engine/mesh/polygonize.h"

#include <functional>

namespace anvil {

/// Takes a point near a surface to a point on it. Called from several threads at once.
using Projection = std::function<Vec3(const Vec3&)>;

/// Newton's steps along the gradient of f, by central differences over `step`, towards f = 0.
Projection projection_onto(ScalarField f, double step);

struct RemeshOptions {
    double edge_length = 0; ///< wanted, same unit as the mesh
    int rounds = 8;         ///< of split, collapse, flip and smoothing
};

/// Isotropic remeshing (after Botsch and Kobbelt 2004): edges between 4/5 and 4/3 of the wanted length,
/// valences near 6, vertices evened out along the surface and put back on it by `project`. The result is
/// closed and manifold with the same topology as `mesh`, bit for bit the same for the same input.
/// @throws InputError if `mesh` is not a closed manifold or the length is not positive.
Mesh remesh(const Mesh& mesh, const Projection& project, const RemeshOptions& options);

/// Remeshed to a number of vertices within 5 % of `vertices` where the surface's topology allows (the caller
/// checks): the edge length is found by trying; large counts come from quartering a coarser mesh.
Mesh remesh_to_count(const Mesh& mesh, const Projection& project, size_t vertices);

} // namespace anvil

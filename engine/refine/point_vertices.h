// Points of a surface made vertices of it: handles and anchors, before anything else is refined.
#pragma once

#include "engine/mesh/surface_point.h"
#include "engine/refine/refined_mesh.h"

namespace anvil {

struct PointVertices {
    RefinedMesh refined;
    std::vector<uint32_t> vertices; ///< one per point
};

/// Divides the triangles of the points so that each point is a vertex. A point inside a face takes two new
/// vertices: the one where the line from a corner through it meets the opposite edge, so that every new
/// vertex has two parents, and then itself.
PointVertices make_vertices(const Mesh& mesh, std::span<const SurfacePoint> points);

} // namespace anvil

// A mesh after some of its triangles were divided: everything that the file had, carried over.
#pragma once

#include "engine/mesh/mesh.h"
#include "engine/refine/edge_mesh.h"

namespace anvil {

/// A vertex that refinement added: at a + place (b - a), place in (0, 1). Its parents have lower indices.
struct VertexParents {
    uint32_t a = 0;
    uint32_t b = 0;
    double place = 0;
};

/// `mesh` has the vertices of the mesh before, in their order, and then one for each entry of `parents`.
struct RefinedMesh {
    Mesh mesh;
    std::vector<VertexParents> parents;
    std::vector<uint32_t> roots; ///< per triangle of `mesh`: the triangle before that it is part of
};

template <class Value>
Value between(const Value& a, const Value& b, double place) {
    return a + place * (b - a);
}

/// `mesh` with the triangles that are roots of `faces` divided into these. Polygons none of whose triangles
/// were divided stay as they are; others become triangles, in place of the polygon. Positions, columns and
/// corner data of new vertices are interpolated (normals to unit length, whole numbers rounded), per side of
/// a seam; columns of polygons and groups go to their triangles.
RefinedMesh divided(const Mesh& mesh, std::vector<VertexParents> parents,
                    std::span<const EdgeMesh::Face> faces);

} // namespace anvil

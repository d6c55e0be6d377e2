// What a refined mesh has to be, judged without the refinement's own code.
#pragma once

#include "engine/refine/adaptive_refinement.h"

#include <string>

namespace anvil::test {

/// One handle at a vertex, with distances as far as refinement needs them.
HandleField field_from(const Mesh& mesh, const std::vector<uint32_t>& vertices, const std::string& preset,
                       double radius);

/// All handles with a preset each, on the mesh's own positions.
RefineState state_of(const Mesh& mesh, std::vector<HandleField> handles);

/// Largest |phi - linear interpolation| of any edge and handle by `samples` samples an edge, with the
/// distance along it from the virtual source of section 3.
double sampled_error(const Mesh& mesh, const std::vector<HandleField>& handles, int samples);

/// Triangles that do not look the way of the triangle that they are part of, or have no area where
/// it has one.
size_t count_flipped(const Mesh& before, const RefinedMesh& after);

double area_of(const Mesh& mesh);
/// Total length of the edges that one triangle has; a T-vertex inside the mesh adds to it.
double boundary_length(const Mesh& mesh);

/// Edges whose ends are both within `off` of the distance, that lie between a triangle inside and one
/// outside.
struct Rim {
    size_t edges = 0;
    size_t odd_vertices = 0; ///< vertices that an odd number of them meets: the chain is not closed there
    size_t crossed_triangles =
        0;               ///< triangles with corners on both sides: the rim is no chain of edges there
    double farthest = 0; ///< of its vertices from the distance
};
Rim rim_of(const Mesh& mesh, const HandleField& handle, double distance, double off);

} // namespace anvil::test

// The triangles around a region, for normals that follow it.
#pragma once

#include "engine/deform/deform_input.h"
#include "engine/mesh/incidence.h"
#include "engine/mesh/mesh.h"
#include "engine/mesh/vertex_numbers.h"

#include <span>
#include <vector>

namespace anvil {

struct RegionFans {
    NormalFans fans;
    /// The vertices of the mesh that `fans` gives normals: the region, then those around it.
    std::vector<uint32_t> vertices;
};

/// The fans of the region's vertices (each once) and of all that share a triangle with one: what a moved
/// region changes. O(region). `positions`: of the whole mesh, world; `origin`: the local origin. `numbers` of
/// the mesh's vertices, clear before and after.
RegionFans fans_around(std::span<const uint32_t> region, const Mesh& mesh, const Incidence& incidence,
                       std::span<const Vec3> positions, const Vec3& origin, VertexNumbers& numbers);

} // namespace anvil

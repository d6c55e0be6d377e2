// Where an edit acts: its handles on the mesh, their distances, and the vertices that it can move.
#pragma once

#include "engine/edit/recipe.h"
#include "engine/edit/shape_function.h"
#include "engine/forge/surface_state.h"

#include <string>
#include <vector>

namespace anvil {

/// An edit's handles on the mesh. Sizes: k handles, n = vertices.size(). Without handles there is the radius
/// of the anchors, or none where the whole mesh takes part.
struct EditRegion {
    std::vector<Vec3> handle_positions;                    ///< k
    std::vector<std::vector<VertexWeight>> handle_weights; ///< k: the vertices that carry each handle
    std::vector<double> radii;                             ///< k, world units
    std::vector<ShapeFunction> shapes;                     ///< k
    std::vector<uint32_t> vertices;                        ///< ascending: t <= 1 for some handle, not pinned
    std::vector<double> fields;       ///< k x n: t = gamma / R, infinite where not reached
    std::vector<std::string> methods; ///< k, how the handle's distances were found, for the report

    /// Weight alpha_j of handle j at vertex `v`; 0 outside the region.
    double weight(size_t j, uint32_t v) const;
};

/// @throws InputError with `place` ("edits[2]") in front: bad addresses, a radius that cannot be defaulted.
EditRegion find_region(const Edit& edit, const std::string& place, SurfaceState& surface);

/// How the distances of handle `j` are measured, and what from: its anchors, or `handle_point`.
DistanceQuery query_of(const Edit& edit, size_t j, const SurfacePoint& handle_point, const std::string& place,
                       SurfaceState& surface);

/// The vertices that carry pinned points, ascending, each once.
std::vector<uint32_t> pinned_vertices(const Edit& edit, const std::string& place, SurfaceState& surface);

} // namespace anvil

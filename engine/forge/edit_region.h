// Where an edit acts: its handles on the mesh, their distances, and the vertices that it can move.
#pragma once

#include "engine/edit/recipe.h"
#include "engine/edit/shape_function.h"
#include "engine/forge/surface_state.h"
#include "engine/mesh/vertex_numbers.h"

#include <functional>
#include <span>
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
    /// t <= 1 for some handle, not pinned. By place (order_by_place()), whatever the mesh's order is: what is
    /// worked side by side then takes about as many steps.
    std::vector<uint32_t> vertices;
    std::vector<uint32_t> by_vertex;  ///< n: indices into `vertices` that make these ascend
    std::vector<double> fields;       ///< k x n: t = gamma / R, infinite where not reached
    std::vector<std::string> methods; ///< k, how the handle's distances were found, for the report

    /// Index of vertex `v` in `vertices`; n outside the region.
    size_t index_of(uint32_t v) const;
    /// Weight alpha_j of handle j at vertex `v`; 0 outside the region.
    double weight(size_t j, uint32_t v) const;
};

/// What an edit's handles are measured from and how far everything is from them: what its region is cut out
/// of, for these radii or smaller ones. Without handles: one field, or none, as `radii` of EditRegion.
struct EditDistances {
    std::vector<Vec3> handle_positions;
    std::vector<std::vector<VertexWeight>> handle_weights;
    std::vector<DistanceField> fields;
    std::vector<double> radii; ///< the handle's, the edit's, or half of the largest finite distance
    std::vector<std::string> methods;
    std::vector<uint32_t> pinned; ///< ascending
};

/// @throws InputError with `place` ("edits[2]") in front: bad addresses, a radius that cannot be defaulted.
EditDistances measure_distances(const Edit& edit, const std::string& place, SurfaceState& surface);

/// One field per query.
using FieldsFinder = std::function<std::vector<DistanceField>(std::span<const DistanceQuery>)>;

/// The same with distances that `find` finds; they may reach farther than asked for.
EditDistances measure_distances(const Edit& edit, const std::string& place, SurfaceState& surface,
                                const FieldsFinder& find);

/// The region by the distances, for `radii` not larger than the measured ones. `positions` of the mesh;
/// `numbers` of its vertices, clear before and after. O(region), or O(mesh) where the whole mesh takes part.
EditRegion region_within(const Edit& edit, const EditDistances& measured, const std::vector<double>& radii,
                         std::span<const Vec3> positions, VertexNumbers& numbers);

/// Makes these ascending vertices the region's, and orders them.
void set_vertices(EditRegion& region, const std::vector<uint32_t>& ascending,
                  std::span<const Vec3> positions);

/// Both. @throws InputError as measure_distances() does.
EditRegion find_region(const Edit& edit, const std::string& place, SurfaceState& surface);

/// The shape functions of the edit's handles. @throws InputError as make_shape_function() does.
std::vector<ShapeFunction> shapes_of(const Edit& edit);

/// Radius of handle `j` as the edit gives it (of the anchors where there are no handles).
std::optional<double> given_radius(const Edit& edit, size_t j);

/// How the distances of handle `j` are measured, and what from: its anchors, or `handle_point`.
DistanceQuery query_of(const Edit& edit, size_t j, const SurfacePoint& handle_point, const std::string& place,
                       SurfaceState& surface);

/// Handles and pinned vertices, nothing measured yet. `queries`: one a handle, for its distances.
EditDistances handles_of(const Edit& edit, const std::string& place, SurfaceState& surface,
                         std::vector<DistanceQuery>& queries);

/// How the distances of the hammered part of an edit without handles are measured: from its anchors, if it
/// has any.
DistanceQuery hammer_query(const Edit& edit, const std::string& place, SurfaceState& surface);

/// The radius of a query, or the default, half of the largest distance. `place` is that of the handle.
double radius_of(const DistanceQuery& query, const std::vector<double>& distances, const std::string& place);

std::string method_name(Metric metric, DistanceMethod method);

/// The vertices that carry pinned points, ascending, each once.
std::vector<uint32_t> pinned_vertices(const Edit& edit, const std::string& place, SurfaceState& surface);

} // namespace anvil

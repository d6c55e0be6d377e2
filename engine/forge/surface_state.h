// A mesh as an edit finds it: points by their addresses, and distances from them.
#pragma once

#include "engine/distance/distance.h"
#include "engine/edit/recipe.h"
#include "engine/mesh/mesh.h"
#include "engine/mesh/search_tree.h"
#include "engine/mesh/surface_point.h"
#include "engine/refine/refined_places.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace anvil {

/// One mesh at one set of positions, both of which must outlive it unchanged. The search tree and the
/// distance solver, O(mesh) each, are built when first asked for and then kept. Not for several threads.
/// `history`: what refinement made of the file's mesh, to which addresses belong, until it is this one.
class SurfaceState {
  public:
    SurfaceState(const Mesh& mesh, std::span<const Vec3> positions, const RefinementHistory& history)
        : mesh_(mesh), positions_(positions), history_(history) {}

    /// `place` begins the message, e.g. "edits[0].handles[1].at".
    /// @throws InputError if an index is out of range or the mesh has no surface to be near to.
    SurfacePoint resolve(const SurfaceAddress& address, const std::string& place);

    /// Distance of every vertex from the nearest of `sources` (eq. 10), up to `radius`; `method` matters to
    /// the geodesic metric alone.
    DistanceField distances(std::span<const SurfacePoint> sources, Metric metric, DistanceMethod method,
                            double radius);

    size_t vertex_count() const { return positions_.size(); }
    Vec3 position_of(const SurfacePoint& point) const;
    /// The vertices that carry the point, weights > 0.
    std::vector<VertexWeight> weights_of(const SurfacePoint& point) const;

  private:
    SurfacePoint at_vertex(uint32_t vertex, const std::string& place);
    SurfacePoint at_face(const FaceAddress& address, const std::string& place) const;
    SurfacePoint near(const Vec3& point, const std::string& place);

    const Mesh& mesh_;
    std::span<const Vec3> positions_;
    const RefinementHistory& history_;
    std::unique_ptr<SearchTree> tree_;
    std::optional<GeodesicSolver> solver_;
};

} // namespace anvil

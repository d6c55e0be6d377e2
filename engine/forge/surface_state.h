// A mesh as an edit finds it: points by their addresses, and distances from them.
#pragma once

#include "engine/distance/distance.h"
#include "engine/edit/recipe.h"
#include "engine/forge/kept_solvers.h"
#include "engine/mesh/mesh.h"
#include "engine/mesh/search_tree.h"
#include "engine/mesh/surface_point.h"
#include "engine/refine/refined_places.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace anvil {

/// What a handle's distances are measured from, and how.
struct DistanceQuery {
    std::vector<DistanceSources> anchors; ///< at least one; no two in one place
    double blend_width = 0;               ///< of a smooth blend of the anchors' fields; 0: the nearest counts
    Metric metric = Metric::geodesic;
    DistanceMethod method = DistanceMethod::automatic; ///< of geodesic distances
    double radius = infinity;
    uint32_t smooth_rounds = 0; ///< geodesic distances run on a copy that was smoothed so often
};

/// One mesh at one set of positions, both of which must outlive it unchanged. The search tree, O(mesh), is
/// built when first asked for and then kept. Not for several threads.
/// `history`: what refinement made of the file's mesh, to which addresses belong, until it is this one.
/// `solvers` of the file's mesh outlive it and serve its next states. `number`: of this surface.
class SurfaceState {
  public:
    SurfaceState(const Mesh& mesh, std::span<const Vec3> positions, const RefinementHistory& history,
                 KeptSolvers& solvers, uint64_t number = new_surface_number())
        : mesh_(mesh), positions_(positions), history_(history), solvers_(solvers), number_(number) {}

    std::span<const Vec3> positions() const { return positions_; }

    /// `place` begins the message, e.g. "edits[0].handles[1].at".
    /// @throws InputError if an index is out of range or the mesh has no surface to be near to.
    SurfacePoint resolve(const SurfaceAddress& address, const std::string& place);

    /// What is left of or became of the polygon's triangles. @throws InputError as resolve() does.
    std::vector<uint32_t> triangles_of(const WholeFaceAddress& face, const std::string& place) const;

    /// Where an address is, in space. @throws InputError as resolve() does.
    Vec3 place_of(const SurfaceAddress& address, const std::string& place);
    /// The mean of a polygon's triangles' centres. @throws InputError as resolve() does.
    Vec3 centre_of(const WholeFaceAddress& face, const std::string& place) const;

    /// The polygon of the file that the surface nearest to a point belongs to. @throws InputError as
    /// resolve().
    WholeFaceAddress face_near(const Vec3& point, const std::string& place);

    /// A line through the points, with all places between that distances need: where two that follow each
    /// other lie in no common triangle, a shortest line on the smoothed copy joins them.
    /// @throws InputError where no way leads from one to the next; `place` is that of the polyline.
    std::vector<SurfacePoint> line_through(std::span<const SurfacePoint> points, uint32_t smooth_rounds,
                                           const std::string& place);

    /// Whether both are one point of the surface, however they are given.
    bool same_place(const SurfacePoint& a, const SurfacePoint& b) const;

    /// One field per query, all at once on all cores.
    std::vector<DistanceField> distances(std::span<const DistanceQuery> queries);

    /// Of geodesic distances on a copy smoothed by `rounds`; built, O(mesh), if that has not been done yet.
    const GeodesicSolver& solver(uint32_t rounds) {
        return solvers_.solver({mesh_, positions_, history_, number_}, rounds);
    }

    size_t vertex_count() const { return positions_.size(); }
    Vec3 position_of(const SurfacePoint& point) const;
    /// The vertices that carry the point, weights > 0.
    std::vector<VertexWeight> weights_of(const SurfacePoint& point) const;

  private:
    void check_vertex(uint32_t vertex, const std::string& place) const;
    SurfacePoint at_vertex(uint32_t vertex);
    SurfacePoint at_face(const FaceAddress& address, const std::string& place) const;
    void check_face(uint32_t face, const std::string& place) const;
    DistanceField straight_distances(const DistanceSources& sources, double radius) const;
    SurfacePoint near(const Vec3& point, const std::string& place);

    const Mesh& mesh_;
    std::span<const Vec3> positions_;
    const RefinementHistory& history_;
    KeptSolvers& solvers_;
    uint64_t number_;
    std::unique_ptr<SearchTree> tree_;
    std::vector<uint32_t> first_triangles_; ///< of the vertices; empty: not asked for yet
};

} // namespace anvil

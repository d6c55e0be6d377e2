// Distances on and through the surface: one number per vertex that is reached.
#pragma once

#include "engine/core/types.h"
#include "engine/edit/distance_method.h"
#include "engine/mesh/mesh.h"
#include "engine/mesh/surface_point.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace anvil {

/// Distances (world units, >= 0) of the vertices that were reached, in order of arrival, each vertex once;
/// every other vertex is infinitely far.
struct DistanceField {
    std::vector<uint32_t> vertices;
    std::vector<double> distances;                       ///< as long as `vertices`
    DistanceMethod method = DistanceMethod::approximate; ///< the one that was used, never `automatic`

    /// One number per vertex, +inf where not reached.
    std::vector<double> dense(size_t vertex_count) const;
};

/// Sources of any kind together.
struct DistanceSources {
    std::vector<SurfacePoint> points;
    /// Lines along the surface; points that follow each other lie in one triangle or on its rim.
    std::vector<std::vector<SurfacePoint>> polylines;
    std::vector<uint32_t> triangles; ///< whole triangles (of Mesh::triangles)
};

class GeodesicMarch;

/// What an update of a solver did anew; the rest was copied.
struct SolverUpdate {
    bool whole = false;   ///< too much was different: everything
    size_t triangles = 0; ///< that are new or were moved
    size_t flipped = 0;   ///< triangles whose intrinsic edges were found anew
    size_t vertices = 0;  ///< whose tables were made anew
};

/// Geodesic distances over a triangulated surface of any kind: edges with any number of faces, boundaries,
/// several components, faces without area, isolated vertices. Prepared once per mesh and positions, O(mesh);
/// a call costs what its region costs. Edge lengths alone matter, so place and scale of the mesh do not:
/// scaled by a power of two the distances are scaled bit for bit.
class GeodesicSolver {
  public:
    /// `positions` stand in for mesh.positions (same count, finite); neither is kept.
    /// @throws InputError if the counts differ or a position is not finite.
    GeodesicSolver(const Mesh& mesh, std::span<const Vec3> positions);
    ~GeodesicSolver();
    GeodesicSolver(GeodesicSolver&&) noexcept;
    GeodesicSolver& operator=(GeodesicSolver&&) noexcept;

    /// Brings the solver up to date after some of its mesh's triangles were divided or moved: `mesh` has the
    /// former vertices, with their numbers, and then new ones; `roots` has for each of its triangles the
    /// former one that it is or is part of (empty: the triangles are the former ones). What is still the same
    /// is found and kept; it may be all or nothing. Distances are then those of a new solver up to rounding
    /// (approximate ones also up to the choice among equally good intrinsic triangulations). Marches go on
    /// over the surface that they began on. Not while another thread uses the solver.
    /// @throws InputError as the constructor does; the solver is then as before.
    SolverUpdate update(const Mesh& mesh, std::span<const Vec3> positions,
                        std::span<const uint32_t> roots = {});

    /// A second solver that is up to date in the same way, while this one stays as it is. What it gives
    /// depends on nothing but this one and the arguments. @throws InputError as update() does.
    GeodesicSolver updated(const Mesh& mesh, std::span<const Vec3> positions,
                           std::span<const uint32_t> roots = {}) const;

    /// Distance to the nearest source, eq. 10 of Bendels & Klein 2003, for all vertices not farther than
    /// `radius`; their values are bit for bit those of radius = infinity. Sources at vertices, on edges and
    /// inside faces; none gives an empty field. Safe to call from several threads at once.
    /// @throws InputError if the radius is NaN or negative, a source names no triangle or vertex of the mesh,
    ///         or its weights are negative or do not sum to 1.
    DistanceField solve(std::span<const SurfacePoint> sources, double radius = infinity,
                        DistanceMethod method = DistanceMethod::automatic) const;

    /// The same for points, polylines and whole triangles. `exact` is exact to rounding.
    /// @throws InputError also if two points that follow each other in a polyline share no triangle.
    DistanceField solve(const DistanceSources& sources, double radius = infinity,
                        DistanceMethod method = DistanceMethod::automatic) const;

    /// A shortest line along the surface: both ends and each edge or vertex between that it meets, as a
    /// polyline of DistanceSources wants it. Straight to rounding wherever it crosses an edge; where two ways
    /// are equally long to within the approximate method's error it may be the other one. Empty if no way
    /// leads there. @throws InputError as solve() does.
    std::vector<SurfacePoint> shortest_line(const SurfacePoint& from, const SurfacePoint& to) const;

    /// Whether both lie in one triangle or on its rim.
    bool share_triangle(const SurfacePoint& a, const SurfacePoint& b) const;

    /// A march to be continued, without sources yet. It chooses its method as solve() does, anew whenever it
    /// has gone on.
    GeodesicMarch march(DistanceMethod method) const;

  private:
    friend class GeodesicMarch;
    struct State;
    explicit GeodesicSolver(std::shared_ptr<State> state) : state_(std::move(state)) {}
    std::shared_ptr<State> state_;
};

/// One field that is kept to go on with: when its radius grows, marching continues where it stopped; when a
/// source is added, only what that improves is done again. Grown in steps it gives, bit for bit, what one
/// call gives. It outlives its solver if need be; one thread at a time.
class GeodesicMarch {
  public:
    ~GeodesicMarch();
    GeodesicMarch(GeodesicMarch&&) noexcept;
    GeodesicMarch& operator=(GeodesicMarch&&) noexcept;

    /// @throws InputError as GeodesicSolver::solve does.
    void add(const DistanceSources& sources);
    /// A smaller radius than before changes nothing. @throws InputError if it is NaN or negative.
    void grow(double radius);

    /// All vertices within the largest radius so far.
    DistanceField field() const;

    /// What has been done so far: vertices marched from and windows made.
    size_t steps() const;

  private:
    friend class GeodesicSolver;
    struct Work;
    GeodesicMarch(std::shared_ptr<GeodesicSolver::State> state, DistanceMethod method);
    std::unique_ptr<Work> work_;
};

/// Straight distance through space from each position to the nearest of `points` and `triangles` (corners in
/// space; a line is a triangle with two corners in one place), for positions not farther than `radius`, in
/// vertex order. @throws InputError if the radius is NaN or negative.
DistanceField euclidean_distances(std::span<const Vec3> positions, std::span<const Vec3> points,
                                  std::span<const std::array<Vec3, 3>> triangles = {},
                                  double radius = infinity);

} // namespace anvil

// Adaptive refinement, eq. 18: vertices where linear interpolation misses what an edit does, and no others.
#pragma once

#include "engine/core/progress.h"
#include "engine/refine/edge_error.h"
#include "engine/refine/refined_mesh.h"

#include <memory>

namespace anvil {

struct RefineOptions {
    double tolerance = 0.001;        ///< in the criterion's unit, > 0
    double min_edge = 0;             ///< world units: no edge is cut into pieces shorter than this
    size_t max_vertices = 1'000'000; ///< of the whole mesh, old and new
    bool flip = false; ///< at the end, flip edges inside divided triangles for larger angles (see flip_edges)
    bool relax = false; ///< and slide new vertices along the edges that they were put on (see relax_vertices)
};

enum class RefineStop { tolerance, min_edge, max_vertices, parting };

/// What refinement works on and adds to. New vertices follow the old ones everywhere.
struct RefineState {
    std::vector<Vec3> positions;
    std::vector<HandleField> handles;
    std::vector<VertexParents> parents; ///< of new vertices

    /// Appends a vertex, with the distances that the edge between its parents gives.
    uint32_t add_vertex(const VertexParents& parents_of_new);

    /// Puts a new vertex that is no vertex's parent elsewhere between its own.
    void move_vertex(uint32_t vertex, double place);

  private:
    Vec3 place_of(const VertexParents& parents) const;
    double distance_at(const AnchorField& anchor, const VertexParents& parents) const;
};

/// Says how wrong linear interpolation is on edges; in batches, since some criteria run the whole edit.
class EdgeCriterion {
  public:
    virtual ~EdgeCriterion() = default;

    /// One entry per edge: its largest error (see EdgeError; at most `enough` suffices), and the kink that is
    /// there: its handle, and its level in `error`.
    struct Finding {
        EdgeError error;
        uint32_t handle = 0;
        bool parted = false; ///< no split brings the error down: the edit tears the surface there
    };
    virtual std::vector<Finding> measure(const RefineState& state, std::span<const EdgeSpan> edges,
                                         double enough) = 0;

    struct FaceFinding {
        double error = 0;
        bool parted = false; ///< as that of an edge
    };
    /// The error inside each face, where edges do not tell it; empty: they do.
    virtual std::vector<FaceFinding> measure_faces(const RefineState& state, std::span<const Triangle> faces,
                                                   double enough);

    /// New vertices have other places and distances than when it last saw them.
    virtual void vertices_moved(const RefineState& state, std::span<const uint32_t> vertices);
};

/// eps = max over handles of |phi_j(g_j(s) / R_j) - linear interpolation of its end values|: dimensionless.
std::unique_ptr<EdgeCriterion> make_shape_criterion();

struct RefineReport {
    size_t added = 0;
    double max_error = 0;    ///< of all edges that remain and are not parted, or a bound of it; in the
                             ///< criterion's unit
    size_t parted_edges = 0; ///< that remain: no split brings them within the tolerance, or only into slivers
    double parted_error = 0; ///< the largest of these
    RefineStop stopped_by = RefineStop::tolerance;
    size_t rounds = 0;
};

/// What refine() gives: `state` with the new vertices, and the divided triangles.
struct Refinement {
    RefineState state;
    std::vector<EdgeMesh::Face> faces; ///< as divided() takes them
    RefineReport report;
};

/// Splits edges at their worst places, round by round, until every edge of the triangles that some handle
/// reaches is within the tolerance or parted, or a limit stops it; and faces within whose edges the criterion
/// still finds an error at the middle of their longest edge. A kink of a shape function at which some edge
/// misses the tolerance becomes a crease: all edges that cross it are split where they do, so that it is a
/// chain of edges (vertices within 5e-7 of the radius count as on it). Distances have to be known up to
/// needed_reach(); sources are vertices.
/// @throws Cancelled.
Refinement refine(std::span<const Triangle> triangles, RefineState state, EdgeCriterion& criterion,
                  const RefineOptions& options, Progress& progress);

/// How far distances from `sources` must be known, so that every edge that comes within `radius` has them at
/// both ends: the radius and twice the longest edge that comes as near.
double needed_reach(std::span<const Triangle> triangles, std::span<const Vec3> positions,
                    std::span<const Vec3> sources, double radius);

} // namespace anvil

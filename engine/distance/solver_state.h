// What a geodesic solver holds: tables of its surface, and the workspaces of its runs.
#pragma once

#include "engine/distance/distance.h"
#include "engine/distance/exact_windows.h"
#include "engine/distance/segment_seeds.h"
#include "engine/distance/surface_tables.h"
#include "engine/distance/vertex_fronts.h"
#include "engine/distance/window_table.h"
#include "engine/distance/workspace_pool.h"

#include <memory>
#include <mutex>

namespace anvil {

/// @throws InputError if the radius is NaN or negative.
void check_radius(double radius);

/// The final part of a run, in world units and with the mesh's numbers.
template <typename Workspace>
DistanceField collect(const Workspace& workspace, const TriangleGraph& graph, double bound) {
    DistanceField field;
    field.vertices.reserve(workspace.reached().size());
    field.distances.reserve(workspace.reached().size());
    for (const uint32_t vertex : workspace.reached()) {
        const double distance = workspace.distance(vertex);
        if (distance <= bound) {
            field.vertices.push_back(graph.numbering.mesh_vertex[vertex]);
            field.distances.push_back(distance * graph.unit);
        }
    }
    return field;
}

/// Shared by the solver and the marches that it began. Runs may come from any number of threads at once.
struct GeodesicSolver::State {
    explicit State(SurfaceTables prepared) : tables(std::move(prepared)) {}

    DistanceField solve(const SourceParts& sources, double radius, DistanceMethod method);

    /// Whether a field, found approximately, is worth finding exactly where nobody chose: it is small, or the
    /// surface is non-manifold in it.
    bool deserves_exact(const DistanceField& field) const;

    std::unique_ptr<VertexFronts> borrow_fronts();
    std::unique_ptr<ExactWindows> borrow_windows();

    SurfaceTables tables;
    const TriangleGraph& graph = tables.graph;
    const FanTable& fans = tables.fans;
    std::mutex window_mutex;
    std::unique_ptr<WindowTable> window_table; ///< made when first asked for, then kept
    WorkspacePool<VertexFronts> front_pool;
    WorkspacePool<ExactWindows> window_pool;

  private:
    DistanceField approximate(const SourceParts& sources, double bound);
    /// @return false if the surface has too many windows.
    bool exact(const SourceParts& sources, double bound, DistanceField& field);
};

} // namespace anvil

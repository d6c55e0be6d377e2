#include "engine/core/error.h"
#include "engine/distance/distance.h"
#include "engine/distance/front_seeds.h"
#include "engine/distance/source_seeds.h"
#include "engine/distance/triangle_graph.h"

#include <mutex>

namespace anvil {
namespace {

TriangleGraph checked_graph(const Mesh& mesh, std::span<const Vec3> positions) {
    if (positions.size() != mesh.vertex_count()) {
        throw InputError("distances: " + std::to_string(positions.size()) + " positions for a mesh of " +
                         std::to_string(mesh.vertex_count()) + " vertices; give one position per vertex");
    }
    for (size_t v = 0; v < positions.size(); ++v) {
        if (!is_finite(positions[v])) {
            throw InputError("distances: the position of vertex " + std::to_string(v) +
                             " is not finite; repair the mesh");
        }
    }
    return make_triangle_graph(mesh.triangles, positions);
}

FanTable flipped_table(TriangleGraph graph) {
    const std::vector<DirectionOrigin> origins = flip_to_delaunay(graph);
    return make_fan_table(graph, origins);
}

} // namespace

/// Workspaces wait in a pool: as many exist as calls ever ran at once.
struct GeodesicSolver::State {
    explicit State(TriangleGraph prepared) : graph(std::move(prepared)), table(flipped_table(graph)) {}

    std::unique_ptr<VertexFronts> borrow() {
        {
            const std::scoped_lock lock(mutex);
            if (!idle.empty()) {
                std::unique_ptr<VertexFronts> kept = std::move(idle.back());
                idle.pop_back();
                return kept;
            }
        }
        return std::make_unique<VertexFronts>(table);
    }

    void give_back(std::unique_ptr<VertexFronts> workspace) {
        const std::scoped_lock lock(mutex);
        idle.push_back(std::move(workspace));
    }

    TriangleGraph graph; ///< as the mesh has it: sources refer to its triangles
    FanTable table;
    std::mutex mutex;
    std::vector<std::unique_ptr<VertexFronts>> idle;
};

GeodesicSolver::GeodesicSolver(const Mesh& mesh, std::span<const Vec3> positions)
    : state_(std::make_unique<State>(checked_graph(mesh, positions))) {}
GeodesicSolver::~GeodesicSolver() = default;
GeodesicSolver::GeodesicSolver(GeodesicSolver&&) noexcept = default;
GeodesicSolver& GeodesicSolver::operator=(GeodesicSolver&&) noexcept = default;

DistanceField GeodesicSolver::solve(std::span<const SurfacePoint> sources, double radius,
                                    DistanceMethod method) const {
    if (!(radius >= 0)) {
        throw InputError("distances: the radius is " + std::to_string(radius) + "; give a number >= 0");
    }
    if (method == DistanceMethod::exact) {
        throw InputError("distances: the method \"exact\" is not there yet; use \"auto\" or \"approximate\"");
    }
    const std::vector<Seed> seeds = seed_sources(state_->graph, sources);
    const double bound = radius / state_->graph.unit;
    std::unique_ptr<VertexFronts> marching = state_->borrow();
    marching->run(front_seeds(state_->graph, state_->table, seeds), bound);
    DistanceField field;
    for (const uint32_t vertex : marching->reached()) {
        const double distance = marching->distance(vertex);
        if (distance <= bound) {
            field.vertices.push_back(vertex);
            field.distances.push_back(distance * state_->graph.unit);
        }
    }
    state_->give_back(std::move(marching));
    return field;
}

std::vector<double> DistanceField::dense(size_t vertex_count) const {
    std::vector<double> all(vertex_count, infinity);
    for (size_t i = 0; i < vertices.size(); ++i) {
        all[vertices[i]] = distances[i];
    }
    return all;
}

} // namespace anvil

#include "engine/core/error.h"
#include "engine/distance/shortest_line.h"
#include "engine/distance/solver_state.h"

namespace anvil {
namespace {

void check_positions(const Mesh& mesh, std::span<const Vec3> positions) {
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
}

SurfaceTables checked_tables(const Mesh& mesh, std::span<const Vec3> positions) {
    check_positions(mesh, positions);
    return make_surface_tables(mesh.triangles, positions);
}

SurfacePoint surface_point(const TriangleGraph& graph, std::span<const uint32_t> mesh_triangle,
                           const PlacedPoint& point) {
    const uint32_t base = point.vertex == no_index ? point.base : graph.sides_leaving(point.vertex)[0];
    SurfacePoint result{mesh_triangle[base / 3], Vec3(0), no_index};
    const int k = static_cast<int>(base % 3);
    result.barycentric[k] = point.vertex == no_index ? 1 - point.weight_end - point.weight_apex : 1;
    result.barycentric[(k + 1) % 3] = point.weight_end;
    result.barycentric[(k + 2) % 3] = point.weight_apex;
    return result;
}

double farthest_corner(const TriangleGraph& graph, const PlacedPoint& point,
                       const std::vector<double>& distances) {
    double farthest = 0;
    for (const uint32_t side : triangles_with(graph, point)) {
        farthest = std::max(
            {farthest, distances[graph.from(side)], distances[graph.to(side)], distances[graph.apex(side)]});
    }
    return farthest;
}

/// Per vertex of the graph and in its units.
std::vector<double> in_graph(const TriangleGraph& graph, const DistanceField& field) {
    std::vector<double> distances(graph.vertex_count(), infinity);
    for (size_t i = 0; i < field.vertices.size(); ++i) {
        distances[graph.numbering.new_vertex[field.vertices[i]]] = field.distances[i] / graph.unit;
    }
    return distances;
}

/// How far from the source of `march` the corners around `target` lie, in units of the graph; infinite if
/// they cannot be reached.
double reach_of(GeodesicMarch march, const TriangleGraph& graph, const PlacedPoint& target) {
    double bound = 8 * graph.longest_side, farthest = infinity;
    while (bound < infinity && farthest == infinity) {
        march.grow(bound * graph.unit);
        farthest = farthest_corner(graph, target, in_graph(graph, march.field()));
        bound = bound < 4 ? 4 * bound : infinity; // the whole mesh is about 1 wide
    }
    return farthest;
}

} // namespace

GeodesicSolver::GeodesicSolver(const Mesh& mesh, std::span<const Vec3> positions)
    : state_(std::make_shared<State>(checked_tables(mesh, positions))) {}
GeodesicSolver::~GeodesicSolver() = default;
GeodesicSolver::GeodesicSolver(GeodesicSolver&&) noexcept = default;
GeodesicSolver& GeodesicSolver::operator=(GeodesicSolver&&) noexcept = default;

SolverUpdate GeodesicSolver::update(const Mesh& mesh, std::span<const Vec3> positions,
                                    std::span<const uint32_t> roots) {
    check_positions(mesh, positions);
    // Marches that are under way keep what they run on.
    const bool shared = state_.use_count() > 1;
    SurfaceTables tables = shared ? state_->tables : std::move(state_->tables);
    std::unique_ptr<WindowTable> windows;
    if (state_->window_table) {
        windows =
            shared ? std::make_unique<WindowTable>(*state_->window_table) : std::move(state_->window_table);
    }
    SurfaceChange change;
    if (!update_surface_tables(tables, mesh.triangles, positions, roots, change)) {
        state_ = std::make_shared<State>(make_surface_tables(mesh.triangles, positions));
        return {true, mesh.triangles.size(), mesh.triangles.size(), mesh.vertex_count()};
    }
    state_ = std::make_shared<State>(std::move(tables));
    if (windows) {
        update_window_table(*windows, state_->graph, change.vertices);
        state_->window_table = std::move(windows);
    }
    return {false, change.triangles.size(), change.flipped, change.fans};
}

GeodesicSolver GeodesicSolver::updated(const Mesh& mesh, std::span<const Vec3> positions,
                                       std::span<const uint32_t> roots) const {
    GeodesicSolver next(state_); // what is shared, update() copies
    next.update(mesh, positions, roots);
    return next;
}

DistanceField GeodesicSolver::solve(std::span<const SurfacePoint> sources, double radius,
                                    DistanceMethod method) const {
    return state_->solve(source_parts(state_->graph, sources, {}, {}), radius, method);
}

DistanceField GeodesicSolver::solve(const DistanceSources& sources, double radius,
                                    DistanceMethod method) const {
    return state_->solve(source_parts(state_->graph, sources.points, sources.polylines, sources.triangles),
                         radius, method);
}

std::vector<SurfacePoint> GeodesicSolver::shortest_line(const SurfacePoint& from,
                                                        const SurfacePoint& to) const {
    const TriangleGraph& graph = state_->graph;
    const PlacedPoint start = placed(graph, from, "line start", 0), end = placed(graph, to, "line end", 0);
    const auto distances_from = [&](const SurfacePoint& source, const PlacedPoint& target) {
        GeodesicMarch way = march(DistanceMethod::approximate);
        way.add({{source}, {}, {}});
        const double reach = reach_of(std::move(way), graph, target);
        return in_graph(graph, solve(std::span(&source, 1), 1.01 * reach * graph.unit));
    };
    // Each end's field has its errors elsewhere.
    SurfaceLine there = anvil::shortest_line(graph, distances_from(to, start), start, end);
    SurfaceLine back = anvil::shortest_line(graph, distances_from(from, end), end, start);
    if (back.length < there.length) {
        std::reverse(back.points.begin(), back.points.end());
        there = std::move(back);
    }
    std::vector<uint32_t> mesh_triangle(graph.triangle_count());
    for (uint32_t t = 0; t < mesh_triangle.size(); ++t) {
        mesh_triangle[graph.numbering.new_triangle[t]] = t;
    }
    std::vector<SurfacePoint> line;
    for (const PlacedPoint& point : there.points) {
        line.push_back(surface_point(graph, mesh_triangle, point));
    }
    return line;
}

bool GeodesicSolver::share_triangle(const SurfacePoint& a, const SurfacePoint& b) const {
    const TriangleGraph& graph = state_->graph;
    const PlacedPoint first = placed(graph, a, "point", 0), second = placed(graph, b, "point", 1);
    const std::vector<uint32_t> triangles = triangles_with(graph, first);
    return std::any_of(triangles.begin(), triangles.end(),
                       [&](uint32_t side) { return place_in(graph, second, side).has_value(); });
}

std::vector<double> DistanceField::dense(size_t vertex_count) const {
    std::vector<double> all(vertex_count, infinity);
    for (size_t i = 0; i < vertices.size(); ++i) {
        all[vertices[i]] = distances[i];
    }
    return all;
}

} // namespace anvil

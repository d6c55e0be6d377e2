#include "engine/core/error.h"
#include "engine/core/number_text.h"
#include "engine/distance/distance.h"
#include "engine/distance/exact_windows.h"
#include "engine/distance/front_seeds.h"
#include "engine/distance/segment_seeds.h"
#include "engine/distance/shortest_line.h"
#include "engine/distance/surface_tables.h"
#include "engine/distance/window_table.h"
#include "engine/distance/workspace_pool.h"

namespace anvil {
namespace {

// Up to this many vertices an exact field takes some 20 ms: a drag starts at once.
constexpr size_t small_region = 5000;

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

void check_radius(double radius) {
    if (!(radius >= 0)) {
        throw InputError("distances: the radius is " + number_text(radius) + "; give a number >= 0");
    }
}

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

} // namespace

struct GeodesicSolver::State {
    explicit State(SurfaceTables prepared) : tables(std::move(prepared)) {}

    DistanceField solve(const SourceParts& sources, double radius, DistanceMethod method) {
        check_radius(radius);
        const double bound = radius / graph.unit;
        DistanceField field;
        if (method == DistanceMethod::exact && exact(sources, bound, field)) {
            return field;
        }
        field = approximate(sources, bound);
        if (method == DistanceMethod::automatic && deserves_exact(field)) {
            exact(sources, bound, field);
        }
        return field;
    }

    DistanceField approximate(const SourceParts& sources, double bound) {
        std::unique_ptr<VertexFronts> fronts = borrow_fronts();
        fronts->clear();
        fronts->add(front_seeds(graph, fans, sources.seeds));
        fronts->grow(bound);
        DistanceField field = collect(*fronts, graph, bound);
        field.method = DistanceMethod::approximate;
        front_pool.give_back(std::move(fronts));
        return field;
    }

    /// @return false if the surface has too many windows.
    bool exact(const SourceParts& sources, double bound, DistanceField& field) {
        std::unique_ptr<ExactWindows> windows = borrow_windows();
        windows->clear();
        windows->add(sources);
        const bool done = windows->grow(bound);
        if (done) {
            field = collect(*windows, graph, bound);
            field.method = DistanceMethod::exact;
        }
        window_pool.give_back(std::move(windows));
        return done;
    }

    /// From `source`, per vertex of the graph and in its units, at least as far as the corners around
    /// `target` if they can be reached.
    std::vector<double> distances_as_far_as(const PlacedPoint& target, const SurfacePoint& source) {
        const SourceParts parts = source_parts(graph, std::span(&source, 1), {}, {});
        double bound = 8 * graph.longest_side, farthest = infinity;
        while (bound < infinity) {
            farthest = farthest_corner(target, in_graph(approximate(parts, bound)));
            if (farthest < infinity) {
                break;
            }
            bound = bound < 4 ? 4 * bound : infinity; // the whole mesh is about 1 wide
        }
        return in_graph(solve(parts, 1.01 * farthest * graph.unit, DistanceMethod::automatic));
    }

    double farthest_corner(const PlacedPoint& point, const std::vector<double>& distances) const {
        double farthest = 0;
        for (const uint32_t side : triangles_with(graph, point)) {
            farthest = std::max({farthest, distances[graph.from(side)], distances[graph.to(side)],
                                 distances[graph.apex(side)]});
        }
        return farthest;
    }

    std::vector<double> in_graph(const DistanceField& field) const {
        std::vector<double> distances(graph.vertex_count(), infinity);
        for (size_t i = 0; i < field.vertices.size(); ++i) {
            distances[graph.numbering.new_vertex[field.vertices[i]]] = field.distances[i] / graph.unit;
        }
        return distances;
    }

    std::unique_ptr<VertexFronts> borrow_fronts() {
        return front_pool.borrow([&] { return VertexFronts(fans); });
    }
    std::unique_ptr<ExactWindows> borrow_windows() {
        {
            const std::scoped_lock lock(window_mutex);
            if (!window_table) {
                window_table = std::make_unique<WindowTable>(make_window_table(graph));
            }
        }
        return window_pool.borrow([&] { return ExactWindows(graph, *window_table); });
    }

    bool deserves_exact(const DistanceField& field) const {
        return field.vertices.size() <= small_region ||
               std::any_of(field.vertices.begin(), field.vertices.end(), [&](uint32_t mesh_vertex) {
                   const uint32_t v = graph.numbering.new_vertex[mesh_vertex];
                   return fans.fans[v].bend == Fan::tangled && !graph.sides_leaving(v).empty();
               });
    }

    SurfaceTables tables;
    const TriangleGraph& graph = tables.graph;
    const FanTable& fans = tables.fans;
    std::mutex window_mutex;
    std::unique_ptr<WindowTable> window_table; ///< made when first asked for, then kept
    WorkspacePool<VertexFronts> front_pool;
    WorkspacePool<ExactWindows> window_pool;
};

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
    // Each end's field has its errors elsewhere.
    SurfaceLine there = anvil::shortest_line(graph, state_->distances_as_far_as(start, to), start, end);
    SurfaceLine back = anvil::shortest_line(graph, state_->distances_as_far_as(end, from), end, start);
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

GeodesicMarch GeodesicSolver::march(DistanceMethod method) const {
    return {state_, method};
}

struct GeodesicMarch::Work {
    Work(std::shared_ptr<GeodesicSolver::State> owner, DistanceMethod method) : state(std::move(owner)) {
        if (method == DistanceMethod::exact) {
            windows = state->borrow_windows();
            windows->clear();
        } else {
            fronts = state->borrow_fronts();
            fronts->clear();
        }
    }
    ~Work() {
        if (windows) {
            state->window_pool.give_back(std::move(windows));
        } else {
            state->front_pool.give_back(std::move(fronts));
        }
    }
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;

    std::shared_ptr<GeodesicSolver::State> state;
    std::unique_ptr<VertexFronts> fronts; ///< one of the two
    std::unique_ptr<ExactWindows> windows;
    double bound = 0;
    uint32_t labels = 0;
};

GeodesicMarch::GeodesicMarch(std::shared_ptr<GeodesicSolver::State> state, DistanceMethod method)
    : work_(std::make_unique<Work>(std::move(state), method)) {}
GeodesicMarch::~GeodesicMarch() = default;
GeodesicMarch::GeodesicMarch(GeodesicMarch&&) noexcept = default;
GeodesicMarch& GeodesicMarch::operator=(GeodesicMarch&&) noexcept = default;

void GeodesicMarch::add(const DistanceSources& sources) {
    const TriangleGraph& graph = work_->state->graph;
    SourceParts parts = source_parts(graph, sources.points, sources.polylines, sources.triangles);
    for (Seed& seed : parts.seeds) {
        seed.label += work_->labels;
    }
    work_->labels +=
        static_cast<uint32_t>(sources.points.size() + sources.polylines.size() + sources.triangles.size());
    if (work_->windows) {
        work_->windows->add(parts);
    } else {
        work_->fronts->add(front_seeds(graph, work_->state->fans, parts.seeds));
    }
    march_on();
}

void GeodesicMarch::grow(double radius) {
    check_radius(radius);
    work_->bound = std::max(work_->bound, radius / work_->state->graph.unit);
    march_on();
}

void GeodesicMarch::march_on() {
    if (!work_->windows) {
        work_->fronts->grow(work_->bound);
    } else if (!work_->windows->grow(work_->bound)) {
        throw InputError(
            "distances: the exact method needs too many windows on this surface; use \"approximate\"");
    }
}

DistanceField GeodesicMarch::field() const {
    const TriangleGraph& graph = work_->state->graph;
    DistanceField field = work_->windows ? collect(*work_->windows, graph, work_->bound)
                                         : collect(*work_->fronts, graph, work_->bound);
    field.method = work_->windows ? DistanceMethod::exact : DistanceMethod::approximate;
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

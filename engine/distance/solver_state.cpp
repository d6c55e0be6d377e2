#include "engine/distance/solver_state.h"

#include "engine/core/error.h"
#include "engine/core/number_text.h"
#include "engine/distance/front_seeds.h"

namespace anvil {
namespace {

// Up to this many vertices an exact field takes some 20 ms: a drag starts at once.
constexpr size_t small_region = 5000;

} // namespace

void check_radius(double radius) {
    if (!(radius >= 0)) {
        throw InputError("distances: the radius is " + number_text(radius) + "; give a number >= 0");
    }
}

DistanceField GeodesicSolver::State::solve(const SourceParts& sources, double radius, DistanceMethod method) {
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

DistanceField GeodesicSolver::State::approximate(const SourceParts& sources, double bound) {
    std::unique_ptr<VertexFronts> fronts = borrow_fronts();
    fronts->clear();
    fronts->add(front_seeds(graph, fans, sources.seeds));
    fronts->grow(bound);
    DistanceField field = collect(*fronts, graph, bound);
    field.method = DistanceMethod::approximate;
    front_pool.give_back(std::move(fronts));
    return field;
}

bool GeodesicSolver::State::exact(const SourceParts& sources, double bound, DistanceField& field) {
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

bool GeodesicSolver::State::deserves_exact(const DistanceField& field) const {
    return field.vertices.size() <= small_region ||
           std::any_of(field.vertices.begin(), field.vertices.end(), [&](uint32_t mesh_vertex) {
               const uint32_t v = graph.numbering.new_vertex[mesh_vertex];
               return fans.fans[v].total == Fan::tangled && !graph.sides_leaving(v).empty();
           });
}

std::unique_ptr<VertexFronts> GeodesicSolver::State::borrow_fronts() {
    return front_pool.borrow([&] { return VertexFronts(fans); });
}

std::unique_ptr<ExactWindows> GeodesicSolver::State::borrow_windows() {
    {
        const std::scoped_lock lock(window_mutex);
        if (!window_table) {
            window_table = std::make_unique<WindowTable>(make_window_table(graph));
        }
    }
    return window_pool.borrow([&] { return ExactWindows(graph, *window_table); });
}

} // namespace anvil

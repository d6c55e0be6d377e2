#include "engine/distance/front_seeds.h"
#include "engine/distance/solver_state.h"

namespace anvil {

struct GeodesicMarch::Work {
    Work(std::shared_ptr<GeodesicSolver::State> owner, DistanceMethod chosen)
        : state(std::move(owner)), method(chosen) {
        if (method == DistanceMethod::exact) {
            begin_exact();
        } else {
            begin_approximate();
        }
    }
    ~Work() {
        end_exact();
        if (fronts) {
            state->front_pool.give_back(std::move(fronts));
        }
    }
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;

    void begin_approximate() {
        fronts = state->borrow_fronts();
        fronts->clear();
        for (const SourceParts& more : parts) {
            add_to_fronts(more);
        }
    }
    void begin_exact() {
        windows = state->borrow_windows();
        windows->clear();
        for (const SourceParts& more : parts) {
            windows->add(more);
        }
    }
    void end_exact() {
        if (windows) {
            ended_steps += windows->windows();
            state->window_pool.give_back(std::move(windows));
        }
    }
    void add_to_fronts(const SourceParts& more) {
        fronts->add(front_seeds(state->graph, state->fans, more.seeds));
    }

    void march_on();
    bool exact_is_wanted() const {
        return !exact_failed && (method == DistanceMethod::exact ||
                                 (method == DistanceMethod::automatic &&
                                  state->deserves_exact(collect(*fronts, state->graph, bound))));
    }

    std::shared_ptr<GeodesicSolver::State> state;
    DistanceMethod method;
    std::unique_ptr<VertexFronts> fronts; ///< unless exact from the start
    std::unique_ptr<ExactWindows> windows;
    bool exact_failed = false; ///< too many windows
    std::vector<SourceParts> parts;
    double bound = 0;
    uint32_t labels = 0;
    size_t ended_steps = 0; ///< of windows given back
};

/// As one call of the solver decides: exact ends where the region outgrows it, or takes over.
void GeodesicMarch::Work::march_on() {
    if (fronts) {
        fronts->grow(bound);
    }
    if (!exact_is_wanted()) {
        end_exact();
        return;
    }
    if (!windows) {
        begin_exact();
    }
    if (!windows->grow(bound)) {
        exact_failed = true;
        end_exact();
        if (!fronts) {
            begin_approximate();
            fronts->grow(bound);
        }
    }
}

GeodesicMarch GeodesicSolver::march(DistanceMethod method) const {
    return {state_, method};
}

GeodesicMarch::GeodesicMarch(std::shared_ptr<GeodesicSolver::State> state, DistanceMethod method)
    : work_(std::make_unique<Work>(std::move(state), method)) {}
GeodesicMarch::~GeodesicMarch() = default;
GeodesicMarch::GeodesicMarch(GeodesicMarch&&) noexcept = default;
GeodesicMarch& GeodesicMarch::operator=(GeodesicMarch&&) noexcept = default;

void GeodesicMarch::add(const DistanceSources& sources) {
    SourceParts more =
        source_parts(work_->state->graph, sources.points, sources.polylines, sources.triangles);
    for (Seed& seed : more.seeds) {
        seed.label += work_->labels;
    }
    work_->labels +=
        static_cast<uint32_t>(sources.points.size() + sources.polylines.size() + sources.triangles.size());
    if (work_->windows) {
        work_->windows->add(more);
    }
    if (work_->fronts) {
        work_->add_to_fronts(more);
    }
    work_->parts.push_back(std::move(more));
    work_->march_on();
}

void GeodesicMarch::grow(double radius) {
    check_radius(radius);
    work_->bound = std::max(work_->bound, radius / work_->state->graph.unit);
    work_->march_on();
}

DistanceField GeodesicMarch::field() const {
    const TriangleGraph& graph = work_->state->graph;
    const bool exact = work_->windows != nullptr;
    DistanceField field =
        exact ? collect(*work_->windows, graph, work_->bound) : collect(*work_->fronts, graph, work_->bound);
    field.method = exact ? DistanceMethod::exact : DistanceMethod::approximate;
    return field;
}

size_t GeodesicMarch::steps() const {
    return work_->ended_steps + (work_->windows ? work_->windows->windows() : 0) +
           (work_->fronts ? work_->fronts->marched() : 0);
}

} // namespace anvil

#include "engine/forge/dilation.h"

#include "engine/core/error.h"
#include "engine/core/parallel_for.h"
#include "engine/deform/cpu_kernel.h"
#include "engine/forge/volume.h"

#include <algorithm>
#include <cmath>

namespace anvil {

namespace {

namespace k = kernel::f64;

constexpr uint32_t default_steps = 32;
constexpr uint32_t most_steps = 64;
constexpr double least_push = 1e-9;     // of the mesh's diagonal: less is rounding
constexpr double fold_limit = 1 / 2.37; // a step higher than this share of w would fold the surface
constexpr double solved = 1e-7;         // of the volume: well below the 0.1 % that is promised
constexpr int most_trials = 8;

double wendland(double r) {
    return r > 0 && r < 1 ? 256.0 / 27 * r * (1 - r) * (1 - r) * (1 - r) : 0;
}

double smoothstep(double x) {
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// The motion cut into at least `steps` samples, none longer than a step.
DeformMotion subdivided(const DeformMotion& motion, size_t handles, uint32_t steps) {
    const size_t samples = std::max<size_t>(motion.times.size(), 1);
    DeformMotion fine = motion;
    fine.targets.clear();
    fine.times.clear();
    for (size_t s = 0; s < samples; ++s) {
        const double from = s == 0 ? 0 : motion.times[s - 1];
        const double to = motion.times.empty() ? 1 : motion.times[s];
        const auto parts = static_cast<size_t>(std::max(1.0, std::ceil((to - from) * steps - 1e-9)));
        for (size_t p = 1; p <= parts; ++p) {
            const double share = static_cast<double>(p) / static_cast<double>(parts);
            fine.times.push_back(p == parts ? to : from + share * (to - from));
            for (size_t j = 0; j < handles; ++j) {
                const Vec3 begin = s == 0 ? Vec3(0) : motion.targets[(s - 1) * handles + j];
                const Vec3& end = motion.targets[s * handles + j];
                fine.targets.push_back(p == parts ? end : begin + share * (end - begin));
            }
        }
    }
    fine.fixed_steps = false;
    fine.steps = std::max<uint32_t>(motion.steps, DeformMotion{}.steps);
    return fine;
}

uint32_t steps_of(const DeformMotion& motion) {
    const size_t wanted = motion.times.size() > 1 ? motion.times.size() : motion.steps;
    return motion.fixed_steps ? static_cast<uint32_t>(std::min<size_t>(wanted, most_steps)) : default_steps;
}

struct State {
    k::DeformKernel::Vertex vertex;
    k::DeformKernel::Walk walk;
};

/// Normals (outward) and areas of the region's vertices.
struct Shape {
    std::vector<Vec3> normals;
    std::vector<double> areas;
};

class Dilator {
  public:
    Dilator(const DilationTask& task, SurfaceState& surface)
        : task_(task), surface_(surface),
          motion_(subdivided(task.motion, task.input.handle_count, steps_of(task.motion))),
          kernel_(task.input, motion_), index_(task.mesh.vertex_count(), no_index) {
        for (const Vec3& p : task.positions) {
            positions_.push_back(p - task.origin);
        }
        Box box;
        for (const Vec3& p : positions_) {
            box.include(p);
        }
        diagonal_ = box.diagonal();
        for (size_t i = 0; i < task.region.vertices.size(); ++i) {
            index_[task.region.vertices[i]] = static_cast<uint32_t>(i);
        }
        for (const Triangle& t : task.mesh.triangles) {
            if (index_[t[0]] != no_index || index_[t[1]] != no_index || index_[t[2]] != no_index) {
                triangles_.push_back(t);
            }
        }
        outward_ = task.closed && enclosed_volume(task.mesh, positions_) < 0 ? -1 : 1;
    }

    DilationResult run() {
        begin();
        DilationResult result;
        for (uint32_t s = 0; s < motion_.times.size(); ++s) {
            if (task_.progress != nullptr) {
                task_.progress->report("dilation", motion_.times[s]);
            }
            const std::vector<double> pushed = advance(s);
            if (task_.closed) {
                result.free_volume = volume([](const State& state) { return state.walk.at; });
            }
            result.height += swell(s, pushed, result.free_volume);
        }
        for (size_t i = 0; i < states_.size(); ++i) {
            const State& state = states_[i];
            result.points.push_back(
                {displacement(state), state.vertex.steps, state.vertex.samples, state.vertex.flags});
        }
        return result;
    }

  private:
    void begin() {
        states_.resize(task_.input.points.size());
        each([&](k::DeformKernel& kernel, size_t i) {
            State& state = states_[i];
            state.vertex = kernel.vertex_at_start(static_cast<uint32_t>(i));
            state.walk = kernel.walk_from(Vec3(0), k::LOOK_START);
            while (state.walk.look != k::LOOK_AHEAD) {
                kernel.look(state.vertex, state.walk);
            }
            state.vertex.nearest = state.walk.here.occluder;
        });
    }

    template <class Work>
    void each(const Work& work) const {
        parallel_for(states_.size(), 256, [&](size_t first, size_t end) {
            k::DeformKernel kernel = kernel_.kernel();
            for (size_t i = first; i < end; ++i) {
                work(kernel, i);
            }
        });
    }

    /// Follows one segment of the path. @return how deep each vertex was pushed in it.
    std::vector<double> advance(uint32_t s) {
        std::vector<double> pushed(states_.size(), 0.0);
        moved_.assign(states_.size(), false);
        std::vector<uint8_t> moved(states_.size(), 0);
        each([&](k::DeformKernel& kernel, size_t i) {
            State& state = states_[i];
            k::DeformKernel::Vertex& vertex = state.vertex;
            const k::DeformKernel::Path path = kernel.path_segment(static_cast<uint32_t>(i), s, vertex.start);
            vertex.segment = s;
            vertex.tau = 0;
            if ((vertex.flags & k::VERTEX_LIMIT_REACHED) != 0 ||
                (kernel.params.moving == 0 && !(path.reach > 0))) {
                return;
            }
            const Vec3 before = vertex.offset - vertex.lift * state.walk.here.normal;
            moved[i] = kernel.pace(path, state.walk.here, vertex) > 0 ? 1 : 0;
            state.walk.look = k::LOOK_AHEAD;
            kernel.proceed(vertex, state.walk, path, k::LOWERS_NEVER);
            const Vec3 after = vertex.offset - vertex.lift * state.walk.here.normal;
            const bool touches = vertex.lift > 0 && !vertex.inside;
            pushed[i] = touches ? std::max(0.0, glm::dot(after - before, state.walk.here.normal)) : 0;
        });
        moved_.assign(moved.begin(), moved.end());
        return pushed;
    }

    Vec3 displacement(const State& state) const {
        k::DeformKernel kernel = kernel_.kernel();
        State lowered = state;
        kernel.begin_lowering(lowered.vertex, lowered.walk);
        while (lowered.walk.look != k::LOOK_NONE) {
            kernel.look(lowered.vertex, lowered.walk);
        }
        return state.walk.at + lowered.vertex.offset;
    }

    /// The whole mesh, the region's vertices displaced.
    template <class Displacement>
    std::vector<Vec3> shape(const Displacement& displaced) const {
        std::vector<Vec3> now = positions_;
        parallel_for(states_.size(), 256, [&](size_t first, size_t end) {
            for (size_t i = first; i < end; ++i) {
                now[task_.region.vertices[i]] = task_.input.points[i] + displaced(states_[i]);
            }
        });
        return now;
    }

    template <class Displacement>
    double volume(const Displacement& displaced) const {
        return outward_ * enclosed_volume(task_.mesh, shape(displaced));
    }

    Shape measure(const std::vector<Vec3>& now) const {
        Shape result{std::vector<Vec3>(states_.size(), Vec3(0)), std::vector<double>(states_.size(), 0.0)};
        for (const Triangle& t : triangles_) {
            const Vec3 n = 0.5 * glm::cross(now[t[1]] - now[t[0]], now[t[2]] - now[t[0]]);
            for (const uint32_t v : t) {
                if (index_[v] != no_index) {
                    result.normals[index_[v]] += outward_ * n;
                    result.areas[index_[v]] += glm::length(n) / 3;
                }
            }
        }
        for (Vec3& n : result.normals) {
            n = glm::length(n) > 0 ? n / glm::length(n) : Vec3(0);
        }
        return result;
    }

    /// g(delta / w) (1 - smoothstep(gamma / w)) of each vertex, gamma the distance from those pushed.
    std::vector<double> profile(const std::vector<double>& pushed) const {
        DistanceSources contact;
        for (size_t i = 0; i < pushed.size(); ++i) {
            if (pushed[i] > least_push * diagonal_) {
                contact.points.push_back(vertex_point(task_.mesh, task_.region.vertices[i]));
            }
        }
        std::vector<double> result(states_.size(), 0.0);
        if (contact.points.empty()) {
            return result;
        }
        DistanceQuery query;
        query.anchors.push_back(std::move(contact));
        query.method = DistanceMethod::approximate;
        query.radius = task_.width;
        const DistanceField field = std::move(surface_.distances({&query, 1})[0]);
        for (size_t f = 0; f < field.vertices.size(); ++f) {
            const uint32_t i = index_[field.vertices[f]];
            if (i == no_index || !moved_[i] || states_[i].vertex.inside) {
                continue;
            }
            const double delta = states_[i].walk.here.distance - states_[i].vertex.lift;
            result[i] = wendland(delta / task_.width) * (1 - smoothstep(field.distances[f] / task_.width));
        }
        return result;
    }

    /// @return rho of this step.
    double swell(uint32_t s, const std::vector<double>& pushed, const std::optional<double>& free_volume) {
        const std::vector<double> g = profile(pushed);
        if (std::none_of(g.begin(), g.end(), [](double x) { return x > 0; })) {
            return 0;
        }
        const auto settled = [this](const State& state) { return displacement(state); };
        const Shape now = measure(shape(settled));
        double unit = 0; // volume of a swelling of height 1
        double removed = 0;
        double deepest = 0;
        for (size_t i = 0; i < g.size(); ++i) {
            unit += g[i] * now.areas[i];
            removed += now.areas[i] * pushed[i] *
                       std::max(0.0, -glm::dot(states_[i].walk.here.normal, now.normals[i]));
            deepest = std::max(deepest, pushed[i]);
        }
        const double most = fold_limit * task_.width;
        const std::vector<State> before = states_;
        if (task_.dilation.solve) {
            return solve(s, g, now, unit, most, *free_volume, before);
        }
        const double rho = task_.dilation.form == DilationForm::depth ? task_.dilation.amount * deepest
                           : unit > 0                                 ? task_.dilation.amount * removed / unit
                                                                      : 0;
        raise(s, g, now, std::min(rho, most), before);
        return std::min(rho, most);
    }

    /// The height at which the volume is the wanted one, by secants: it is almost linear.
    double solve(uint32_t s, const std::vector<double>& g, const Shape& now, double unit, double most,
                 double wanted, const std::vector<State>& before) {
        const auto settled = [this](const State& state) { return displacement(state); };
        double last = 0;
        double last_missing = wanted - volume(settled);
        double rho = unit > 0 ? std::clamp(last_missing / unit, 0.0, most) : 0;
        for (int trial = 0; trial < most_trials && rho != last; ++trial) {
            raise(s, g, now, rho, before);
            const double missing = wanted - volume(settled);
            if (std::abs(missing) <= solved * std::abs(wanted) || missing == last_missing) {
                break;
            }
            const double next = rho + missing * (rho - last) / (last_missing - missing);
            last = rho;
            last_missing = missing;
            rho = std::clamp(next, 0.0, most);
        }
        return rho;
    }

    /// From `before`, each vertex goes rho g along its normal, past the occluders as they stand at the end of
    /// segment s.
    void raise(uint32_t s, const std::vector<double>& g, const Shape& now, double rho,
               const std::vector<State>& before) {
        const std::vector<k::Pose> rest = resting_poses(s + 1);
        states_ = before;
        each([&](k::DeformKernel& kernel, size_t i) {
            if (!(g[i] * rho > 0)) {
                return;
            }
            State& state = states_[i];
            kernel.poses = rest.data();
            kernel.params.motion = k::MOTION_STRAIGHT;
            kernel.params.steps = k::STEPS_ADAPTIVE;
            kernel.params.step_limit = no_index;
            kernel.params.sample_count = 1;
            const Vec3 by = g[i] * rho * now.normals[i];
            state.vertex.segment = 0;
            state.vertex.tau = 0;
            const Vec3 at = state.walk.at;
            const k::DeformKernel::Path path{at, at + by, Vec3(0), Vec3(0), glm::length(by)};
            state.walk.look = k::LOOK_AHEAD;
            kernel.proceed(state.vertex, state.walk, path, k::LOWERS_NEVER);
            state.walk.at = at;
            state.vertex.offset += by; // what was a path is a correction from now on
            state.vertex.segment = s;
            state.vertex.tau = 1;
        });
    }

    std::vector<k::Pose> resting_poses(size_t sample) const {
        std::vector<k::Pose> rest;
        const size_t count = task_.input.occluders.occluders.size();
        if (kernel_.poses().empty()) {
            return rest;
        }
        for (size_t copy = 0; copy < 2; ++copy) {
            for (size_t o = 0; o < count; ++o) {
                k::Pose pose = kernel_.poses()[sample * count + o];
                pose.move = Vec3(0);
                pose.turn = 0;
                pose.growth = 0;
                rest.push_back(pose);
            }
        }
        return rest;
    }

    const DilationTask& task_;
    SurfaceState& surface_;
    DeformMotion motion_;
    CpuKernel kernel_;
    std::vector<uint32_t> index_; ///< of mesh vertices in the region
    std::vector<Vec3> positions_; ///< local
    std::vector<Triangle> triangles_;
    std::vector<State> states_;
    std::vector<bool> moved_; ///< in this step, or an occluder past it
    double diagonal_ = 0;
    double outward_ = 1;
};

} // namespace

DilationResult dilate(const DilationTask& task, SurfaceState& surface) {
    if (task.dilation.solve && !task.closed) {
        throw InputError(
            "dilation: the mesh is open and encloses no volume to solve for; give \"amount\" in place of "
            "\"solve\"");
    }
    return Dilator(task, surface).run();
}

} // namespace anvil

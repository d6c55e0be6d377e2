#include "engine/forge/edit_motion.h"

#include "engine/core/error.h"
#include "engine/edit/handle_path.h"
#include "engine/edit/rotation.h"
#include "engine/occluder/occluder_motion.h"

#include <algorithm>
#include <cmath>

namespace anvil {

namespace {

constexpr int newton_steps =
    6; // rotations of points inside faces: the error falls by the face's angle each time
constexpr uint32_t paper_steps = 32;

std::vector<double> system_matrix(const EditRegion& region) {
    const size_t k = region.shapes.size();
    std::vector<double> a(k * k, 0.0);
    for (size_t i = 0; i < k; ++i) {
        for (size_t j = 0; j < k; ++j) {
            for (const VertexWeight& w : region.handle_weights[i]) {
                a[i * k + j] += w.weight * region.weight(j, w.vertex);
            }
        }
    }
    return a;
}

HandlePath path_of(const Handle& handle, const Vec3& start) {
    if (!handle.path.empty()) {
        return HandlePath(handle.path);
    }
    const Vec3 by = handle.by ? *handle.by : *handle.to - start;
    return HandlePath({&by, 1});
}

/// The times at which an occluder (`times`) or a path changes its direction, and the end. Equal steps are
/// `count` segments, so that all of them are equal, whatever corners the path has.
std::vector<double> sample_times(const std::vector<HandlePath>& paths, std::vector<double> times,
                                 const Steps& steps) {
    times.push_back(1);
    for (const HandlePath& path : paths) {
        const std::vector<double> corners = path.corners();
        times.insert(times.end(), corners.begin(), corners.end());
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    if (times.size() == 1 || steps.adaptive) {
        return times;
    }
    times.clear();
    for (uint32_t i = 1; i <= steps.count; ++i) {
        times.push_back(static_cast<double>(i) / steps.count);
    }
    return times;
}

/// D at every time, k x 3S: what the handles have moved by then.
std::vector<double> displacement_targets(const Edit& edit, const std::vector<HandlePath>& paths,
                                         const std::vector<double>& times) {
    std::vector<double> targets;
    for (const HandlePath& path : paths) {
        for (const double t : times) {
            const Vec3 by = edit.amount * path.at(t);
            targets.insert(targets.end(), {by.x, by.y, by.z});
        }
    }
    return targets;
}

/// How far handle i is from its path, at most.
double largest_miss(const std::vector<double>& a, const std::vector<double>& x,
                    const std::vector<double>& targets, size_t k, size_t i) {
    const size_t columns = targets.size() / k;
    double largest = 0;
    for (size_t s = 0; s < columns; s += 3) {
        Vec3 miss(0);
        for (int c = 0; c < 3; ++c) {
            miss[c] = -targets[i * columns + s + c];
            for (size_t j = 0; j < k; ++j) {
                miss[c] += a[i * k + j] * x[j * columns + s + c];
            }
        }
        largest = std::max(largest, glm::length(miss));
    }
    return largest;
}

std::vector<double> angle_targets(const Edit& edit, const EditRegion& region, const Rotation& turn) {
    std::vector<double> targets;
    for (size_t i = 0; i < edit.handles.size(); ++i) {
        const Handle& handle = edit.handles[i];
        const double angle = handle.degrees ? glm::radians(*handle.degrees)
                                            : turn.angle_to_reach(region.handle_positions[i], *handle.to);
        targets.push_back(edit.amount * angle);
    }
    return targets;
}

/// Where handle i ends when its vertices turn by sum_j alpha_j(v) x_j.
Vec3 turned_handle(const EditRegion& region, std::span<const Vec3> positions, const Rotation& turn,
                   std::span<const double> x, size_t i) {
    Vec3 end(0);
    for (const VertexWeight& w : region.handle_weights[i]) {
        double angle = 0;
        for (size_t j = 0; j < x.size(); ++j) {
            angle += region.weight(j, w.vertex) * x[j];
        }
        end += w.weight * turn.turned(positions[w.vertex], angle);
    }
    return end;
}

/// Missing angle of every handle: target minus where the point on the moved face stands.
std::vector<double> missing_angles(const EditRegion& region, std::span<const Vec3> positions,
                                   const Rotation& turn, std::span<const double> x,
                                   std::span<const double> targets) {
    std::vector<double> missing(targets.size());
    for (size_t i = 0; i < targets.size(); ++i) {
        const Vec3 wanted = turn.turned(region.handle_positions[i], targets[i]);
        missing[i] = turn.angle_to_reach(turned_handle(region, positions, turn, x, i), wanted);
    }
    return missing;
}

bool any_inside_face(const EditRegion& region) {
    for (const auto& weights : region.handle_weights) {
        if (weights.size() > 1) {
            return true;
        }
    }
    return false;
}

void correct_angles(const EditRegion& region, std::span<const Vec3> positions, const Rotation& turn,
                    const std::vector<double>& a, std::span<const double> targets, Solution& solution) {
    for (int step = 0; step < newton_steps; ++step) {
        const auto missing = missing_angles(region, positions, turn, solution.x, targets);
        const Solution correction = solve_constraints(a, missing, 1);
        for (size_t j = 0; j < solution.x.size(); ++j) {
            solution.x[j] += correction.x[j];
        }
    }
}

void set_steps(const Steps& steps, DeformMotion& motion) {
    motion.fixed_steps = !steps.adaptive;
    motion.steps = !steps.adaptive && motion.times.size() > 1 ? 1 : steps.count;
}

Steps steps_of(const Edit& edit, const OccluderSet& occluders) {
    return edit.steps.value_or(occluders.paper ? Steps{false, paper_steps} : Steps{});
}

MotionKind kind_of(const Edit& edit) {
    return edit.kind == EditKind::translate ? MotionKind::straight
           : edit.sweep == Sweep::arc       ? MotionKind::arc
                                            : MotionKind::chord;
}

std::vector<std::string> handle_names(const Edit& edit, const std::string& place) {
    std::vector<std::string> names;
    for (size_t i = 0; i < edit.handles.size(); ++i) {
        names.push_back(place + ".handles[" + std::to_string(i) + "] (" + describe(edit.handles[i].at) + ")");
    }
    return names;
}

EditMotion translation(const Edit& edit, const EditRegion& region, const std::vector<double>& a,
                       const std::vector<std::string>& names, const std::vector<double>& poses,
                       const Steps& steps, Log& log) {
    EditMotion result;
    const size_t k = edit.handles.size();
    std::vector<HandlePath> paths;
    for (size_t i = 0; i < k; ++i) {
        paths.push_back(path_of(edit.handles[i], region.handle_positions[i]));
    }
    const std::vector<double> times = sample_times(paths, poses, steps);
    const auto targets = displacement_targets(edit, paths, times);
    result.solution = solve_constraints(a, targets, 3 * times.size());
    check_targets(result.solution, targets, edit.least_squares, names, log);
    for (size_t i = 0; i < k; ++i) {
        result.target_errors.push_back(largest_miss(a, result.solution.x, targets, k, i));
    }
    for (size_t s = 0; s < times.size(); ++s) {
        for (size_t j = 0; j < k; ++j) {
            const double* x = &result.solution.x[3 * (j * times.size() + s)];
            result.motion.targets.emplace_back(x[0], x[1], x[2]);
        }
    }
    result.motion.times = times;
    return result;
}

EditMotion rotation(const Edit& edit, const EditRegion& region, std::span<const Vec3> positions,
                    const std::vector<double>& a, const std::vector<std::string>& names,
                    const std::vector<double>& times, const Vec3& origin, Log& log) {
    EditMotion result;
    const Rotation turn(edit.axis.origin, edit.axis.direction);
    const auto targets = angle_targets(edit, region, turn);
    result.solution = solve_constraints(a, targets, 1);
    check_targets(result.solution, targets, edit.least_squares, names, log);
    if (any_inside_face(region) && !edit.least_squares) {
        correct_angles(region, positions, turn, a, targets, result.solution);
    }
    for (size_t i = 0; i < edit.handles.size(); ++i) {
        const Vec3 end = turned_handle(region, positions, turn, result.solution.x, i);
        result.target_errors.push_back(
            glm::length(end - turn.turned(region.handle_positions[i], targets[i])));
    }
    for (const double t : times) {
        for (const double angle : result.solution.x) {
            result.motion.targets.emplace_back(t * angle, 0, 0);
        }
    }
    result.motion.times = times;
    result.motion.kind = kind_of(edit);
    result.motion.axis_origin = turn.origin - origin;
    result.motion.axis_direction = turn.direction;
    return result;
}

} // namespace

EditMotion find_motion(const Edit& edit, const EditRegion& region, std::span<const Vec3> positions,
                       const Vec3& origin, const std::string& place, const OccluderSet& occluders, Log& log) {
    const auto a = system_matrix(region);
    const auto names = handle_names(edit, place);
    const Steps steps = steps_of(edit, occluders);
    const std::vector<double> poses = pose_times(occluders);
    EditMotion result =
        edit.kind == EditKind::translate
            ? translation(edit, region, a, names, poses, steps, log)
            : rotation(edit, region, positions, a, names, sample_times({}, poses, steps), origin, log);
    set_steps(steps, result.motion);
    return result;
}

DeformMotion foreseen_motion(const Edit& edit, const OccluderSet& occluders) {
    std::vector<HandlePath> paths;
    for (const Handle& handle : edit.handles) {
        if (!handle.path.empty()) {
            paths.emplace_back(handle.path);
        }
    }
    DeformMotion motion;
    const Steps steps = steps_of(edit, occluders);
    motion.kind = kind_of(edit);
    motion.times = sample_times(paths, pose_times(occluders), steps);
    motion.targets.resize(edit.handles.size() * motion.times.size());
    set_steps(steps, motion);
    return motion;
}

} // namespace anvil

#include "engine/deform/deform_input.h"

#include "engine/core/error.h"
#include "engine/core/parallel_for.h"
#include "engine/occluder/occluder_kernel.h"
#include "engine/occluder/occluder_motion.h"

#include <algorithm>

namespace anvil {

namespace {

/// Sampled field first; the exact distance where contact acts, where the sign may be wrong. The occluder of
/// least clearance counts as in the kernel, unless the point is inside another one.
double start_distance(const OccluderSet& set, kernel::f64::OccluderKernel& kernel, const Vec3& p) {
    double best_clearance = infinity;
    double best = infinity;
    double deepest = 0;
    for (uint32_t k = 0; k < set.occluders.size(); ++k) {
        const auto& occluder = set.occluders[k];
        double distance = kernel.occluder_probe(k, p).distance;
        if (occluder.settle > 0 && distance < 2 * occluder.margin) {
            distance = exact_distance(set, k, p).distance;
        }
        if (distance < 0 && distance >= -touching_distance(set, k)) {
            distance = 0;
        }
        deepest = std::min(deepest, distance);
        if (distance - occluder.margin < best_clearance) {
            best_clearance = distance - occluder.margin;
            best = distance;
        }
    }
    return deepest < 0 ? deepest : best;
}

size_t sample_count(const DeformInput& input, const DeformMotion& motion) {
    return input.handle_count == 0 ? std::max<size_t>(motion.times.size(), 1)
                                   : motion.targets.size() / input.handle_count;
}

} // namespace

void find_start_distances(DeformInput& input) {
    input.start_distances.clear();
    if (input.occluders.empty()) {
        return;
    }
    input.start_distances.resize(input.points.size());
    const OccluderSet& set = input.occluders;
    parallel_for(input.points.size(), 1024, [&](size_t begin, size_t end) {
        kernel::f64::OccluderKernel kernel{set.segments.data(), set.nodes.data(), set.occluders.data(),
                                           set.volumes.data(), set.words()};
        for (size_t i = begin; i < end; ++i) {
            input.start_distances[i] = start_distance(set, kernel, input.points[i]);
        }
    });
}

void check_sizes(const DeformInput& input, const DeformMotion& motion) {
    const size_t n = input.points.size();
    const size_t k = input.handle_count;
    const bool fits = input.fields.size() == k * n && input.shapes.size() == k &&
                      (input.occluders.empty() || input.start_distances.size() == n) &&
                      fits_handles(motion, k) && input.fans.normal_count() <= n + input.fans.rim.size();
    if (!fits) {
        throw InternalError("the deformation's input and motion do not fit each other");
    }
}

bool fits_handles(const DeformMotion& motion, size_t handle_count) {
    const size_t samples = motion.times.size();
    const size_t entries = motion.targets.size();
    if (handle_count == 0) {
        return entries == 0 && motion.steps > 0;
    }
    return entries > 0 && entries % handle_count == 0 &&
           (samples == 0 || entries == samples * handle_count) && motion.steps > 0;
}

std::vector<kernel::f64::Pose> kernel_poses(const DeformInput& input, const DeformMotion& motion) {
    if (!motion.times.empty()) {
        return pose_table(input.occluders, motion.times);
    }
    std::vector<double> times(sample_count(input, motion));
    for (size_t s = 0; s < times.size(); ++s) {
        times[s] = static_cast<double>(s + 1) / static_cast<double>(times.size());
    }
    return pose_table(input.occluders, times);
}

kernel::f64::KernelParams kernel_params(const DeformInput& input, const DeformMotion& motion) {
    namespace k = kernel::f64;
    k::KernelParams params{};
    params.point_count = static_cast<uint32_t>(input.points.size());
    params.field_stride = params.point_count;
    params.handle_count = static_cast<uint32_t>(input.handle_count);
    params.sample_count = static_cast<uint32_t>(sample_count(input, motion));
    params.occluder_count = static_cast<uint32_t>(input.occluders.occluders.size());
    params.motion = motion.kind == MotionKind::straight ? k::MOTION_STRAIGHT
                    : motion.kind == MotionKind::arc    ? k::MOTION_ARC
                                                        : k::MOTION_CHORD;
    params.paper = input.occluders.paper ? 1 : 0;
    params.moving = input.occluders.moves() ? 1 : 0;
    params.steps = !motion.fixed_steps ? k::STEPS_ADAPTIVE
                   : motion.every_step ? k::STEPS_EVERY
                                       : k::STEPS_FIXED;
    params.step_limit = motion.steps;
    params.axis_origin = motion.axis_origin;
    params.axis_direction = motion.axis_direction;
    params.path_epsilon = motion.path_epsilon;
    return params;
}

SegmentTable segment_table(const DeformInput& input) {
    SegmentTable table{input.occluders.segments, input.shapes};
    const auto offset = static_cast<uint32_t>(table.segments.size());
    table.segments.insert(table.segments.end(), input.segments.begin(), input.segments.end());
    for (auto& shape : table.shapes) {
        shape.first += offset;
    }
    return table;
}

} // namespace anvil

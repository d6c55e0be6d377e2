// What both back ends consume: a list of points without topology, and a motion.
#pragma once

#include "engine/core/types.h"
#include "engine/occluder/occluder_set.h"

#include <vector>

namespace anvil {

/// The triangles around an input's n points, for normals that follow them. Vertices are numbered: the points,
/// then those of `rim`.
struct NormalFans {
    std::vector<Vec3> rim;       ///< places that stand still, relative to the local origin
    std::vector<uint32_t> begin; ///< normal_count() + 1 runs of `corners`, for the first so many vertices
    std::vector<kernel::f64::FanCorner> corners;

    bool empty() const { return begin.empty(); }
    size_t normal_count() const { return empty() ? 0 : begin.size() - 1; }
};

/// The part of an edit that does not change while it is dragged. Lengths in world units relative to the
/// edit's local origin.
struct DeformInput {
    std::vector<Vec3> points; ///< n
    size_t handle_count = 0;  ///< k
    std::vector<double>
        fields; ///< k x n, handle by handle: t = gamma / R; > 1 or infinite outside the region
    std::vector<kernel::f64::ShapeSegment> segments; ///< shape functions of the handles
    std::vector<kernel::f64::CurveRange> shapes;     ///< k runs of `segments`
    OccluderSet occluders;
    /// n: signed distance of the nearest occluder at each point (exact sign, exact value within the band
    /// where contact acts), negative if it is inside any; empty without occluders. See
    /// find_start_distances().
    std::vector<double> start_distances;
    NormalFans fans; ///< empty: no normals are asked for
};

/// Fills input.start_distances from input.points and input.occluders, on all cores.
void find_start_distances(DeformInput& input);

enum class MotionKind { straight, arc, chord };

/// Where the handles go. `targets` holds for each path sample s = 1..S the partial displacements X_j of the k
/// handles (S x k): vectors, or for arc and chord the partial angle in radians in x. The path runs from zero
/// through the samples.
struct DeformMotion {
    MotionKind kind = MotionKind::straight;
    Vec3 axis_origin{0};          ///< relative to the local origin
    Vec3 axis_direction{0, 1, 0}; ///< unit
    std::vector<Vec3> targets;    ///< empty without handles: then S is the number of `times`, at least 1
    std::vector<double> times;    ///< S, ascending to 1: when each sample is reached; empty: equal parts
    bool fixed_steps =
        false; ///< exactly `steps` equal steps a path segment, else adaptive with at most `steps`
    bool every_step = false; ///< fixed steps that meet nothing are taken too: slower, the same result
    uint32_t steps = 4096;
    double path_epsilon = 0; ///< shorter paths do not move a vertex
};

/// What happened to a point.
struct PointResult {
    Vec3 displacement; ///< from the point before the edit to after it
    uint32_t steps;
    uint32_t samples; ///< occluder evaluations
    uint32_t flags;   ///< kernel::f64::VERTEX_*
};

/// @throws InternalError if sizes of input and motion do not fit each other.
void check_sizes(const DeformInput& input, const DeformMotion& motion);

/// Whether a motion is one of `handle_count` handles.
bool fits_handles(const DeformMotion& motion, size_t handle_count);

/// The occluders' poses at the motion's samples; empty if none moves. See pose_table().
std::vector<kernel::f64::Pose> kernel_poses(const DeformInput& input, const DeformMotion& motion);

/// The kernels' parameters of a motion over `point_count` points.
kernel::f64::KernelParams kernel_params(const DeformInput& input, const DeformMotion& motion);

/// Segments of the handles' shapes with those of the occluders' influence curves in front, the handles'
/// ranges moved accordingly: the one `segments` array that the kernels read.
struct SegmentTable {
    std::vector<kernel::f64::ShapeSegment> segments;
    std::vector<kernel::f64::CurveRange> shapes;
};
SegmentTable segment_table(const DeformInput& input);

} // namespace anvil

// Occluders that move while an edit acts: hammers.
#pragma once

#include "engine/occluder/occluder_set.h"
#include "engine/occluder/shape_nodes.h"

#include <span>
#include <vector>

namespace anvil {

/// The pose at time t: before the first and after the last it rests; between two, origin and logarithm of the
/// scale go linearly and the rotation turns at equal speed the shorter way (slerp). At least one pose.
Placement pose_at(std::span<const TimedPose> poses, double t);

/// The poses of an entry in the recipe, in world space; what a pose leaves out is the entry's transform,
/// which must be filled in (occluders_of()). Empty for an occluder that stands still.
std::vector<TimedPose> timed_poses(const OccluderUse& use);

/// The part of a motion up to time `share` in [0, 1], over all of the time.
std::vector<TimedPose> first_part(std::span<const TimedPose> poses, double share);

/// Makes the last occluder of the set move: its pose becomes the first one's, its contact band that of its
/// largest scale. `poses` relative to the set's local origin; fewer than two do nothing.
void set_motion(OccluderSet& set, std::vector<TimedPose> poses);

/// Times strictly between 0 and 1 at which an occluder has a pose, ascending, each once.
std::vector<double> pose_times(const OccluderSet& set);

/// Where every occluder is at time 0 and at each of `times`, and how it goes on from there: as the kernels
/// read it, (times + 1) x occluders, sample by sample. Empty if nothing moves.
std::vector<kernel::f64::Pose> pose_table(const OccluderSet& set, std::span<const double> times);

/// The set as it stands at the end, all at rest.
OccluderSet at_end(const OccluderSet& set);

/// Where a point that is fastened to an occluder goes when that goes from one pose to another.
Vec3 carried(const kernel::f64::Occluder& from, const kernel::f64::Occluder& to, const Vec3& p);

} // namespace anvil

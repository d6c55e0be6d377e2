#include "engine/occluder/occluder_motion.h"

#include "engine/edit/rotation.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace anvil {

namespace {

namespace k = kernel::f64;

struct Turn {
    Vec3 axis{0, 1, 0};
    double angle = 0; ///< in [0, pi]
};

glm::dmat3 matrix(const Placement& place) {
    return {place.axes[0], place.axes[1], place.axes[2]};
}

Turn turn_between(const Placement& from, const Placement& to) {
    if (from.axes == to.axes) {
        return {};
    }
    glm::dquat q = glm::normalize(glm::quat_cast(matrix(to) * glm::transpose(matrix(from))));
    if (q.w < 0) {
        q = -q;
    }
    const Vec3 v(q.x, q.y, q.z);
    const double size = glm::length(v);
    return size > 0 ? Turn{v / size, 2 * std::atan2(size, q.w)} : Turn{};
}

Placement between(const Placement& a, const Placement& b, double share) {
    const Turn turn = turn_between(a, b);
    const Rotation rotation(Vec3(0), turn.axis);
    Placement result;
    for (size_t i = 0; i < 3; ++i) {
        result.axes[i] = rotation.turned(a.axes[i], share * turn.angle);
    }
    result.origin = a.origin + share * (b.origin - a.origin);
    result.scale = a.scale == b.scale ? a.scale : a.scale * std::pow(b.scale / a.scale, share);
    return result;
}

Transform resolved(const MotionPose& pose, const Transform& rest) {
    Transform result = rest;
    result.translate = pose.translate.value_or(rest.translate);
    if (pose.rotate) {
        result.axis = pose.rotate->axis;
        result.degrees = pose.rotate->degrees;
    }
    result.scale = pose.scale.value_or(rest.scale);
    return result;
}

Placement placement_of(const k::Occluder& occluder) {
    return {{occluder.axis_x, occluder.axis_y, occluder.axis_z}, occluder.origin, occluder.scale};
}

void place(k::Occluder& occluder, const Placement& at) {
    occluder.axis_x = at.axes[0];
    occluder.axis_y = at.axes[1];
    occluder.axis_z = at.axes[2];
    occluder.origin = at.origin;
    occluder.scale = at.scale;
}

/// Pose of an occluder at `now`, relative to where it is at `base`, and on to `next`.
k::Pose pose_of(const Placement& base, const Placement& now, const Placement& next, double at) {
    k::Pose pose{};
    pose.axis_x = Vec3(1, 0, 0);
    pose.axis_y = Vec3(0, 1, 0);
    pose.axis_z = Vec3(0, 0, 1);
    if (now.axes != base.axes) {
        const glm::dmat3 turned = matrix(now) * glm::transpose(matrix(base));
        pose.axis_x = turned[0];
        pose.axis_y = turned[1];
        pose.axis_z = turned[2];
    }
    const Turn turn = turn_between(now, next);
    pose.origin = now.origin;
    pose.move = next.origin - now.origin;
    pose.turn_axis = turn.axis;
    pose.turn = turn.angle;
    pose.ratio = now.scale / base.scale;
    pose.growth = next.scale == now.scale ? 0 : std::log(next.scale / now.scale);
    pose.at = at;
    return pose;
}

} // namespace

Placement pose_at(std::span<const TimedPose> poses, double t) {
    const auto next =
        std::find_if(poses.begin(), poses.end(), [t](const TimedPose& pose) { return pose.at >= t; });
    if (next == poses.end()) {
        return poses.back().place;
    }
    if (next == poses.begin() || next->at == t) {
        return next->place;
    }
    const TimedPose& before = *(next - 1);
    return between(before.place, next->place, (t - before.at) / (next->at - before.at));
}

std::vector<TimedPose> timed_poses(const OccluderUse& use) {
    std::vector<TimedPose> poses;
    for (const MotionPose& pose : use.motion) {
        poses.push_back({pose.at, placement(resolved(pose, *use.transform))});
    }
    return poses;
}

std::vector<TimedPose> first_part(std::span<const TimedPose> poses, double share) {
    std::vector<TimedPose> part;
    for (const TimedPose& pose : poses) {
        if (share > 0 && pose.at < share) {
            part.push_back({pose.at / share, pose.place});
        }
    }
    if (!poses.empty()) {
        part.push_back({1, pose_at(poses, share)});
    }
    return part;
}

void set_motion(OccluderSet& set, std::vector<TimedPose> poses) {
    if (poses.empty()) {
        return;
    }
    k::Occluder& occluder = set.occluders.back();
    const double scale = occluder.scale;
    double largest = 0;
    for (const TimedPose& pose : poses) {
        largest = std::max(largest, pose.place.scale / scale);
    }
    occluder.margin *= largest;
    occluder.step *= largest;
    occluder.settle *= largest;
    set.sizes.back() *= poses.front().place.scale / scale;
    place(occluder, poses.front().place);
    if (poses.size() > 1) {
        set.motions.resize(set.occluders.size());
        set.motions.back() = std::move(poses);
    }
}

std::vector<double> pose_times(const OccluderSet& set) {
    std::vector<double> times;
    for (const auto& poses : set.motions) {
        for (const TimedPose& pose : poses) {
            if (pose.at > 0 && pose.at < 1) {
                times.push_back(pose.at);
            }
        }
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

std::vector<k::Pose> pose_table(const OccluderSet& set, std::span<const double> times) {
    std::vector<k::Pose> table;
    if (!set.moves()) {
        return table;
    }
    const auto at = [&](size_t occluder, double t) {
        const bool moves = occluder < set.motions.size() && !set.motions[occluder].empty();
        return moves ? pose_at(set.motions[occluder], t) : placement_of(set.occluders[occluder]);
    };
    for (size_t s = 0; s <= times.size(); ++s) {
        const double now = s == 0 ? 0 : times[s - 1];
        const double next = s == times.size() ? now : times[s];
        for (size_t i = 0; i < set.occluders.size(); ++i) {
            table.push_back(pose_of(placement_of(set.occluders[i]), at(i, now), at(i, next), now));
        }
    }
    return table;
}

OccluderSet at_end(const OccluderSet& set) {
    OccluderSet end = set;
    end.motions.clear();
    for (size_t i = 0; i < set.motions.size(); ++i) {
        if (!set.motions[i].empty()) {
            const Placement last = pose_at(set.motions[i], 1);
            end.sizes[i] *= last.scale / set.occluders[i].scale;
            place(end.occluders[i], last);
        }
    }
    return end;
}

Vec3 carried(const k::Occluder& from, const k::Occluder& to, const Vec3& p) {
    const Vec3 arm = (p - from.origin) * (to.scale / from.scale);
    return to.origin + to.axis_x * glm::dot(from.axis_x, arm) + to.axis_y * glm::dot(from.axis_y, arm) +
           to.axis_z * glm::dot(from.axis_z, arm);
}

} // namespace anvil

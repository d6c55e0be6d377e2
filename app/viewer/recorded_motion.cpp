#include "app/viewer/recorded_motion.h"

#include "engine/occluder/occluder_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace anvil {

namespace {

glm::dquat rotation_of(const Placement& place) {
    return glm::quat_cast(glm::dmat3(place.axes[0], place.axes[1], place.axes[2]));
}

double way(const Placement& a, const Placement& b, double size) {
    const double same = std::min(std::abs(glm::dot(rotation_of(a), rotation_of(b))), 1.0);
    const double turn = 2 * std::acos(same);
    return glm::length(b.origin - a.origin) + size * (turn + std::abs(std::log(b.scale / a.scale)));
}

/// Marks the poses between two that are kept which they do not tell by themselves.
void keep_between(std::span<const TimedPose> poses, size_t first, size_t last, double size, double tolerance,
                  std::vector<bool>& kept) {
    const std::array<TimedPose, 2> ends{poses[first], poses[last]};
    size_t worst = first;
    double most = tolerance;
    for (size_t i = first + 1; i < last; ++i) {
        const double off = way(pose_at(ends, poses[i].at), poses[i].place, size);
        if (off > most) {
            most = off;
            worst = i;
        }
    }
    if (worst != first) {
        kept[worst] = true;
        keep_between(poses, first, worst, size, tolerance, kept);
        keep_between(poses, worst, last, size, tolerance, kept);
    }
}

} // namespace

double way_between(const Transform& a, const Transform& b, double size) {
    return way(placement(a), placement(b), size);
}

std::vector<MotionPose> recorded_motion(std::span<const Transform> poses, double size, double tolerance) {
    std::vector<TimedPose> timed;
    std::vector<size_t> source;
    double length = 0;
    for (size_t i = 0; i < poses.size(); ++i) {
        const double step = i == 0 ? 0 : way_between(poses[i - 1], poses[i], size);
        if (i == 0 || step > 0) {
            length += step;
            timed.push_back({length, placement(poses[i])});
            source.push_back(i);
        }
    }
    if (timed.size() < 2) {
        return {};
    }
    for (TimedPose& pose : timed) {
        pose.at /= length;
    }
    timed.back().at = 1;
    std::vector<bool> kept(timed.size(), false);
    kept.front() = kept.back() = true;
    keep_between(timed, 0, timed.size() - 1, size, tolerance, kept);
    const Transform& start = poses.front();
    const bool turns = std::any_of(poses.begin(), poses.end(), [&](const Transform& pose) {
        return pose.degrees != start.degrees || pose.axis != start.axis;
    });
    const bool grows = std::any_of(poses.begin(), poses.end(),
                                   [&](const Transform& pose) { return pose.scale != start.scale; });
    std::vector<MotionPose> motion;
    for (size_t i = 0; i < timed.size(); ++i) {
        // Times that rounding made equal are one.
        if (!kept[i] || (!motion.empty() && !(timed[i].at > motion.back().at))) {
            continue;
        }
        const Transform& pose = poses[source[i]];
        MotionPose& entry = motion.emplace_back();
        entry.at = timed[i].at;
        entry.translate = pose.translate;
        if (turns) {
            entry.rotate = MotionPose::Turn{pose.axis, pose.degrees};
        }
        if (grows) {
            entry.scale = pose.scale;
        }
    }
    return motion;
}

} // namespace anvil

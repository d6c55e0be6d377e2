#include "engine/edit/recipe_parts.h"
#include "engine/edit/rotation.h"

#include <cmath>

namespace anvil {

namespace {

MotionPose read_pose(const JsonReader& entry) {
    entry.check_keys({"at", "translate", "rotate", "scale", "transform"});
    MotionPose pose;
    pose.at = entry.required("at").within(0, 1);
    const bool nested = entry.has("transform");
    if (nested && (entry.has("translate") || entry.has("rotate") || entry.has("scale"))) {
        entry.fail("give \"translate\", \"rotate\" and \"scale\" either right here or in \"transform\"");
    }
    const JsonReader keys = nested ? entry.required("transform") : entry;
    const Transform transform = nested ? read_transform(keys) : read_pose_keys(keys);
    if (keys.has("translate")) {
        pose.translate = transform.translate;
    }
    if (keys.has("rotate")) {
        pose.rotate = MotionPose::Turn{transform.axis, transform.degrees};
    }
    if (keys.has("scale")) {
        pose.scale = transform.scale;
    }
    return pose;
}

/// Between poses the shorter way is taken: about one axis, what is written would not be what happens.
void check_turn(const JsonReader& entry, const MotionPose& before, const MotionPose& pose) {
    if (!before.rotate || !pose.rotate) {
        return;
    }
    const Vec3 a = Rotation(Vec3(0), before.rotate->axis).direction;
    const Vec3 b = Rotation(Vec3(0), pose.rotate->axis).direction;
    const double same = glm::dot(a, b);
    if (std::abs(same) < 1 - 1e-9) {
        return;
    }
    const double turn = pose.rotate->degrees * (same > 0 ? 1 : -1) - before.rotate->degrees;
    if (std::abs(turn) >= 180) {
        entry.required("rotate").fail_found(
            "turns by 180 degrees or more since the pose before, which leaves the "
            "way open: put poses between");
    }
}

} // namespace

std::vector<MotionPose> read_motion(const JsonReader& list) {
    std::vector<MotionPose> poses;
    for (const JsonReader& entry : list.items()) {
        poses.push_back(read_pose(entry));
        if (poses.size() < 2) {
            continue;
        }
        const MotionPose& before = poses[poses.size() - 2];
        if (!(poses.back().at > before.at)) {
            entry.required("at").fail_found("the times of a motion must increase");
        }
        check_turn(entry, before, poses.back());
    }
    if (poses.size() < 2) {
        list.fail_found(
            "a motion has at least two poses, e.g. [{\"at\": 0, \"translate\": [0,1,0]}, {\"at\": 1, "
            "\"translate\": [0,0,0]}]; to place an occluder give \"transform\"");
    }
    return poses;
}

} // namespace anvil

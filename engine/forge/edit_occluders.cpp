#include "engine/forge/edit_occluders.h"

#include "engine/core/error.h"
#include "engine/occluder/occluder_motion.h"

namespace anvil {

namespace {

std::vector<TimedPose> local_motion(const OccluderUse& use, double amount, const Vec3& origin) {
    std::vector<TimedPose> poses = first_part(timed_poses(use), amount);
    for (TimedPose& pose : poses) {
        pose.place.origin -= origin;
    }
    return poses;
}

} // namespace

EditOccluders::EditOccluders(const Recipe& recipe, Log& log, Progress& progress, const FileCache* cache)
    : recipe_(recipe) {
    for (size_t i = 0; i < recipe.occluders.size(); ++i) {
        const Occluder& occluder = recipe.occluders[i];
        try {
            models_.emplace(occluder.name, build_model(occluder.shape, field_of(occluder), progress,
                                                       {recipe_folder(recipe), &log}, cache));
        } catch (const InputError& error) {
            throw InputError("occluders[" + std::to_string(i) + "] \"" + occluder.name +
                             "\": " + error.what());
        }
    }
}

OccluderSet EditOccluders::set_for(const Edit& edit, const OccluderScale& scale,
                                   const std::string& place) const {
    OccluderSet set;
    try {
        for (const OccluderUse& use : uses_of(edit)) {
            add_occluder(set, models_.at(use.name), use.name, *use.transform, *use.influence, scale);
            set_motion(set, local_motion(use, edit.amount, scale.origin));
        }
    } catch (const InputError& error) {
        throw InputError(place + ": " + error.what());
    }
    return set;
}

} // namespace anvil

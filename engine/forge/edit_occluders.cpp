#include "engine/forge/edit_occluders.h"

#include "engine/core/error.h"
#include "engine/occluder/occluder_motion.h"

#include <algorithm>

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

bool KeptModels::Kept::is_of(const Occluder& occluder) const {
    return shape == occluder.shape && field == field_of(occluder);
}

std::shared_ptr<const OccluderModel> KeptModels::model(const Occluder& occluder,
                                                       const std::filesystem::path& folder, Log& log,
                                                       Progress& progress, const FileCache* cache,
                                                       SearchDevice* device) {
    for (const Kept& kept : kept_) {
        if (kept.folder == folder && kept.is_of(occluder)) {
            return kept.model;
        }
    }
    const Field field = field_of(occluder);
    auto model = std::make_shared<const OccluderModel>(
        build_model(occluder.shape, field, progress, {folder, &log}, cache, device));
    kept_.push_back({occluder.shape, field, folder, model});
    return model;
}

void KeptModels::drop_all_but(const std::vector<const Occluder*>& used) {
    std::erase_if(kept_, [&](const Kept& kept) {
        return std::none_of(used.begin(), used.end(),
                            [&](const Occluder* occluder) { return kept.is_of(*occluder); });
    });
}

EditOccluders::EditOccluders(const Recipe& recipe, Log& log, Progress& progress, const FileCache* cache,
                             KeptModels* kept, SearchDevice* device)
    : recipe_(recipe) {
    KeptModels own;
    KeptModels& models = kept != nullptr ? *kept : own;
    for (size_t i = 0; i < recipe.occluders.size(); ++i) {
        const Occluder& occluder = recipe.occluders[i];
        try {
            models_.emplace(occluder.name,
                            models.model(occluder, recipe_folder(recipe), log, progress, cache, device));
        } catch (const InputError& error) {
            throw InputError("occluders[" + std::to_string(i) + "] \"" + occluder.name +
                             "\": " + error.what());
        }
    }
}

OccluderModels EditOccluders::models_of(const std::vector<OccluderUse>& uses) const {
    OccluderModels models;
    models.reserve(uses.size());
    for (const OccluderUse& use : uses) {
        models.push_back(models_.at(use.name));
    }
    return models;
}

OccluderSet EditOccluders::set_for(const Edit& edit, const OccluderScale& scale,
                                   const std::string& place) const {
    OccluderSet set;
    try {
        for (const OccluderUse& use : uses_of(edit)) {
            add_occluder(set, *models_.at(use.name), use.name, *use.transform, *use.influence, scale);
            set_motion(set, local_motion(use, edit.amount, scale.origin));
        }
    } catch (const InputError& error) {
        throw InputError(place + ": " + error.what());
    }
    return set;
}

} // namespace anvil

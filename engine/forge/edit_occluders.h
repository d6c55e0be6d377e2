// The occluders of a recipe's edits: models built once, sets for each edit.
#pragma once

#include "engine/core/file_cache.h"
#include "engine/core/log.h"
#include "engine/core/progress.h"
#include "engine/edit/recipe.h"
#include "engine/occluder/occluder_set.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace anvil {

/// Models that outlast a recipe, by shape and field. What changes in their files meanwhile is not seen.
class KeptModels {
  public:
    /// Baked fields come from `cache` and go there, if there is one; `device`, if there is one, helps baking.
    /// @throws as build_model() does.
    std::shared_ptr<const OccluderModel> model(const Occluder& occluder, const std::filesystem::path& folder,
                                               Log& log, Progress& progress, const FileCache* cache,
                                               SearchDevice* device);

    /// Lets go of those of no occluder of these.
    void drop_all_but(const std::vector<const Occluder*>& used);

  private:
    struct Kept {
        OccluderShape shape;
        Field field;
        std::filesystem::path folder;
        std::shared_ptr<const OccluderModel> model;

        bool is_of(const Occluder& occluder) const;
    };
    std::vector<Kept> kept_;
};

using OccluderModels = std::vector<std::shared_ptr<const OccluderModel>>;

class EditOccluders {
  public:
    /// Builds the models of all occluders that are not among the kept ones, and bakes those that the recipe
    /// says to. The recipe must outlive this; where its occluders are, move and how they act may change
    /// meanwhile, their shapes and fields not. @throws InputError naming the place in the recipe; Cancelled;
    /// DeviceError.
    EditOccluders(const Recipe& recipe, Log& log, Progress& progress, const FileCache* cache,
                  KeptModels* kept = nullptr, SearchDevice* device = nullptr);

    /// Those that one edit uses, each where its pose and motion put it. `place` is "edits[i]".
    /// @throws InputError
    OccluderSet set_for(const Edit& edit, const OccluderScale& scale, const std::string& place) const;

    /// Which ones an edit uses, everything filled in.
    std::vector<OccluderUse> uses_of(const Edit& edit) const { return occluders_of(recipe_, edit); }

    /// The models of these uses: the same ones as long as shapes and fields stay.
    OccluderModels models_of(const std::vector<OccluderUse>& uses) const;

  private:
    const Recipe& recipe_;
    std::map<std::string, std::shared_ptr<const OccluderModel>> models_;
};

} // namespace anvil

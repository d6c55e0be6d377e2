// The occluders of a recipe's edits: models built once, sets for each edit.
#pragma once

#include "engine/core/file_cache.h"
#include "engine/core/log.h"
#include "engine/core/progress.h"
#include "engine/edit/recipe.h"
#include "engine/occluder/occluder_set.h"

#include <map>
#include <string>

namespace anvil {

class EditOccluders {
  public:
    /// Builds the models of all occluders, and bakes those that the recipe says to. The recipe must outlive
    /// this; where its occluders are, move and how they act may change meanwhile, their shapes and fields
    /// not. @throws InputError naming the place in the recipe; Cancelled.
    EditOccluders(const Recipe& recipe, Log& log, Progress& progress, const FileCache* cache);

    /// Those that one edit uses, each where its pose and motion put it. `place` is "edits[i]".
    /// @throws InputError
    OccluderSet set_for(const Edit& edit, const OccluderScale& scale, const std::string& place) const;

    /// Which ones an edit uses, everything filled in.
    std::vector<OccluderUse> uses_of(const Edit& edit) const { return occluders_of(recipe_, edit); }

  private:
    const Recipe& recipe_;
    std::map<std::string, OccluderModel> models_;
};

} // namespace anvil

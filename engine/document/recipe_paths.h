// The files that a recipe names: where they lie, and how they are written beside the recipe.
#pragma once

#include "engine/edit/recipe.h"

#include <filesystem>

namespace anvil {

/// Every file of the recipe (its mesh, those of its occluders) by its absolute path.
Recipe with_absolute_paths(Recipe recipe);

/// Every file as a recipe in `folder` names it: relative, so that both can be moved together. The paths of
/// `recipe` are absolute.
Recipe with_paths_from(Recipe recipe, const std::filesystem::path& folder);

/// Whether both names stand for one file, be it there already or not.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Whether the recipe, its paths absolute, reads this file.
bool reads(const Recipe& recipe, const std::filesystem::path& file);

} // namespace anvil

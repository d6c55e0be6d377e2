// Curves that a person keeps: files of shape functions, in a folder of their own or anywhere.
#pragma once

#include "engine/edit/recipe.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace anvil {

/// "curves" in user_data_folder(); none without one.
std::optional<std::filesystem::path> curve_folder();

/// The names of the curves in a folder, without ".json", in order. Empty if there is none.
std::vector<std::string> curves_in(const std::optional<std::filesystem::path>& folder);

/// Where a curve of that name is: a path if it has a folder in it or ends in .json, else in `folder`.
/// @throws InputError for an empty name, or one where there is no folder
std::filesystem::path curve_file(const std::string& name, const std::optional<std::filesystem::path>& folder);

/// Writes the curve, and the folder if it is not there. @throws InputError, WriteError
void save_curve(const ShapeChoice& shape, const std::filesystem::path& file);

/// Buttons and names under a curve: a curve of the person's, or of a file, in place of this one.
class CurveFiles {
  public:
    /// Within a panel. Whether `shape` is another one.
    bool show(ShapeChoice& shape);

  private:
    bool load(ShapeChoice& shape, const std::string& name);

    std::string name_;
    std::string said_; ///< of the last one: saved where, or what was wrong
};

} // namespace anvil

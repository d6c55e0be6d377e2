// A shape function in a file of its own, for use in many recipes.
#pragma once

#include "engine/edit/recipe.h"

#include <filesystem>
#include <string>

namespace anvil {

/// JSON text of what "shape" is in a recipe: {"knots": [...]}, or a preset's name in quotes; `file_name` is
/// for messages. @throws InputError as parse_recipe() does.
ShapeChoice parse_shape(const std::string& text, const std::string& file_name);

/// The same of a file. @throws InputError also if it cannot be read.
ShapeChoice read_shape_file(const std::filesystem::path& file);

/// Whole or not at all. @throws WriteError
void write_shape_file(const std::filesystem::path& file, const ShapeChoice& shape);

} // namespace anvil

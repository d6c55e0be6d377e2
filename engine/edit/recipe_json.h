// The recipe's file format.
#pragma once

#include "engine/edit/recipe.h"

#include <filesystem>
#include <string>

namespace anvil {

/// Reads a recipe from JSON text; `file_name` goes into Recipe::file and into messages. Everything that the
/// text alone can tell is checked; indices into the mesh are not.
/// @throws InputError with file, line and column (syntax) or path of the key ("edits[0].handles[1].by"), what
/// was found and what would mend it.
Recipe parse_recipe(const std::string& text, const std::string& file_name);

/// parse_recipe() of a file. @throws InputError also if the file cannot be read.
Recipe read_recipe(const std::filesystem::path& path);

/// JSON text that parses to an equal recipe (apart from Recipe::file); numbers have as many digits as they
/// need, at most 17. @throws InternalError if a number is not finite.
std::string write_recipe(const Recipe& recipe);

} // namespace anvil

// A session without a person: lines of a text file that make the same events as mouse and keys.
#pragma once

#include "app/viewer/input_event.h"
#include "engine/core/types.h"

#include <filesystem>
#include <string>
#include <vector>

namespace anvil {

/// One line: a word and what follows it, quotes taken off.
struct ScriptLine {
    size_t number = 0; ///< in the file, from 1
    std::string word;
    std::vector<std::string> arguments;
};

/// Empty lines and those that begin with # are left out. @throws InputError if the file cannot be read, for
/// an unknown word (names the nearest) or a wrong number of arguments.
std::vector<ScriptLine> read_script(const std::filesystem::path& file);

/// `ctrl+shift+z`, `escape`: the key and what is held. @throws InputError for an unknown key
InputEvent key_event(const std::string& text, bool down);

/// A finite number. @throws InputError
double script_number(const std::string& text);

/// `x,y,z`. @throws InputError
Vec3 script_point(const std::string& text);

} // namespace anvil

// A whole file in memory, or an error that says why not.
#pragma once

#include <filesystem>
#include <string>

namespace anvil {

/// The bytes of a regular file. @throws InputError if it is missing, a directory, a device, or unreadable.
std::string read_file(const std::filesystem::path& path);

} // namespace anvil

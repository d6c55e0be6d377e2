// Output files appear whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace anvil {

/// Writes a temporary file in the same folder and renames it over `path` (links are followed). Devices such
/// as /dev/stdout are written directly. @throws WriteError naming the path; then nothing has changed there.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> content);
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

} // namespace anvil

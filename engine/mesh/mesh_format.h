// Which format a file name stands for.
#pragma once

#include <filesystem>

namespace anvil {

enum class MeshFormat { obj, ply, stl, off };

/// By extension, in any case. @throws InputError for any other; nothing need exist there.
MeshFormat mesh_format(const std::filesystem::path& path);

} // namespace anvil

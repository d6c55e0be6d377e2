// Mesh files in: OBJ, PLY (ASCII and both binary orders), STL (both), OFF.
#pragma once

#include "engine/core/log.h"
#include "engine/mesh/mesh.h"

#include <filesystem>

namespace anvil {

/// Reads and triangulates the mesh; the format is that of the extension (any case). All vertices are kept in
/// file order (STL: equal positions welded, first occurrence first); faces of fewer than three corners are
/// left out. What is odd but can be worked with becomes a warning, that of examine() included.
/// @throws InputError (file, line or byte, cause, mend) if the file cannot be read, is damaged, has a vertex
/// that is not finite or beyond 1e36, an index without vertex, or no face that has area.
Mesh read_mesh(const std::filesystem::path& path, Log& log);

} // namespace anvil

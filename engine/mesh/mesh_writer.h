// Mesh files out: OBJ, PLY (binary little-endian), STL (binary), OFF.
#pragma once

#include "engine/mesh/mesh.h"

#include <filesystem>
#include <span>

namespace anvil {

/// Number type of written positions. automatic: double where the input was more precise than float, or where
/// float would cost more than 1e-8 of the diagonal. Text formats print the shortest decimal that reads back
/// the same. STL has only float.
enum class OutputPrecision { automatic, single_precision, double_precision };

/// Whether positions of this mesh are written as double. @pre positions has n entries.
bool needs_double(const Mesh& mesh, std::span<const Vec3> positions, OutputPrecision precision);

/// Writes the mesh's polygons and attributes with these positions (n entries), in the format of the
/// extension. Positions equal to the mesh's own are written exactly as they were read. What the format cannot
/// hold is left out: normals and (OFF) texture coordinates per corner become vertex columns where all corners
/// of a vertex agree. The file appears whole or not at all.
/// @throws InputError for an unknown extension, WriteError naming the path if it cannot be written.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh, std::span<const Vec3> positions,
                OutputPrecision precision = OutputPrecision::automatic);

/// The same after an edit that `moved` vertices (n entries): the file's own normals are turned along, as
/// update_normals() does.
void write_edited_mesh(const std::filesystem::path& path, const Mesh& mesh, std::span<const Vec3> positions,
                       const std::vector<bool>& moved,
                       OutputPrecision precision = OutputPrecision::automatic);

} // namespace anvil

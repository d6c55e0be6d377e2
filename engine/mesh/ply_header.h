// The header of a PLY file (internal to engine/mesh).
#pragma once

#include "engine/mesh/mesh_source.h"

#include <optional>

namespace anvil {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

struct PlyProperty {
    std::string name;
    ScalarType type = ScalarType::float32;
    std::optional<ScalarType> count_type; ///< of lists
};

struct PlyElement {
    std::string name;
    uint64_t count = 0;
    size_t line = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::vector<std::string> comments; ///< "comment ..." and "obj_info ..." lines
    size_t data = 0;                   ///< where the data begins in the file
};

/// Reads the header and checks that the file is long enough for what it announces.
/// @throws InputError if it is not, or the header is damaged.
PlyHeader read_ply_header(const MeshSource& source);

size_t size_of(ScalarType type);
const char* ply_name(ScalarType type);

} // namespace anvil

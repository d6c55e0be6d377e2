// What the writers of the four formats share (internal to engine/mesh).
#pragma once

#include "engine/mesh/mesh.h"

#include <bit>
#include <span>
#include <string>

namespace anvil {

/// A mesh with the positions to write.
struct MeshOutput {
    const Mesh& mesh;
    std::span<const Vec3> positions;
    bool use_double = false;
};

std::string format_obj(const MeshOutput& output);
std::string format_ply(const MeshOutput& output);
std::string format_stl(const MeshOutput& output);
std::string format_off(const MeshOutput& output);

/// "x y z" as text: unchanged positions exactly, changed ones as precise as use_double says.
void append_position(std::string& text, const MeshOutput& output, size_t vertex);

/// The columns of these names, all of them or none; the last `optional` ones may be missing.
std::vector<const Column*> find_columns(const std::vector<Column>& columns,
                                        std::span<const char* const> names, size_t optional = 0);

/// Per-corner data as one column per component, where all corners of each vertex agree (vertices without: 0);
/// empty if some do not.
std::vector<Column> as_vertex_columns(const Mesh& mesh, const CornerLayer& layer,
                                      std::span<const char* const> names);

/// The mesh's vertex columns and, if it has none of them, "nx", "ny", "nz" from its corner normals.
std::vector<Column> columns_with_normals(const Mesh& mesh);

bool is_integer(ScalarType type);

inline constexpr std::array<const char*, 3> normal_names = {"nx", "ny", "nz"};
inline constexpr std::array<const char*, 4> colour_names = {"red", "green", "blue", "alpha"};
inline constexpr std::array<const char*, 2> texture_names = {"s", "t"};

/// Appends a number's bytes in little-endian order.
template <typename T>
void append_bytes(std::string& bytes, T value) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::big) {
        std::reverse(raw.begin(), raw.end());
    }
    bytes.append(raw.data(), raw.size());
}

} // namespace anvil

#include "engine/core/atomic_file.h"
#include "engine/core/decimal.h"
#include "engine/core/error.h"
#include "engine/mesh/health.h"
#include "engine/mesh/mesh_format.h"
#include "engine/mesh/mesh_output.h"
#include "engine/mesh/mesh_writer.h"
#include "engine/mesh/normals.h"
#include "engine/mesh/precision.h"

namespace anvil {

void append_position(std::string& text, const MeshOutput& output, size_t vertex) {
    const Vec3& p = output.positions[vertex];
    const bool exact = output.use_double || p == output.mesh.positions[vertex];
    for (int axis = 0; axis < 3; ++axis) {
        text += axis > 0 ? " " : "";
        if (exact) {
            append_number(text, p[axis]);
        } else {
            append_number(text, static_cast<float>(p[axis]));
        }
    }
}

std::vector<const Column*> find_columns(const std::vector<Column>& columns,
                                        std::span<const char* const> names, size_t optional) {
    std::vector<const Column*> found;
    for (const char* name : names) {
        const auto column =
            std::find_if(columns.begin(), columns.end(), [name](const Column& c) { return c.name == name; });
        if (column == columns.end()) {
            break;
        }
        found.push_back(&*column);
    }
    if (found.size() + optional < names.size()) {
        found.clear();
    }
    return found;
}

std::vector<Column> as_vertex_columns(const Mesh& mesh, const CornerLayer& layer,
                                      std::span<const char* const> names) {
    if (layer.empty() || layer.components < static_cast<int>(names.size())) {
        return {};
    }
    std::vector<uint32_t> entry(mesh.vertex_count(), no_index);
    const auto value = [&layer](uint32_t index, size_t i) {
        return layer.values[index * static_cast<size_t>(layer.components) + i];
    };
    for (size_t c = 0; c < mesh.corners.size(); ++c) {
        uint32_t& known = entry[mesh.corners[c]];
        const uint32_t index = layer.index[c];
        if (known == no_index) {
            known = index;
        }
        for (size_t i = 0; i < names.size() && known != index; ++i) {
            if (index == no_index || value(known, i) != value(index, i)) {
                return {};
            }
        }
    }
    std::vector<Column> columns;
    for (size_t i = 0; i < names.size(); ++i) {
        columns.push_back({names[i], ScalarType::float32, std::vector<double>(mesh.vertex_count(), 0)});
        for (size_t v = 0; v < mesh.vertex_count(); ++v) {
            columns[i].values[v] = entry[v] == no_index ? 0 : value(entry[v], i);
        }
    }
    return columns;
}

std::vector<Column> columns_with_normals(const Mesh& mesh) {
    std::vector<Column> columns = mesh.vertex_columns;
    if (find_columns(columns, normal_names).empty()) {
        const std::vector<Column> normals = as_vertex_columns(mesh, mesh.corner_normals, normal_names);
        columns.insert(columns.end(), normals.begin(), normals.end());
    }
    return columns;
}

bool is_integer(ScalarType type) {
    return type != ScalarType::float32 && type != ScalarType::float64;
}

bool needs_double(const Mesh& mesh, std::span<const Vec3> positions, OutputPrecision precision) {
    if (precision != OutputPrecision::automatic) {
        return precision == OutputPrecision::double_precision;
    }
    Box box;
    for (const Vec3& p : positions) {
        box.include(p);
    }
    return mesh.double_precision || float_loss(positions) > float_loss_limit * box.diagonal();
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh, std::span<const Vec3> positions,
                OutputPrecision precision) {
    if (positions.size() != mesh.vertex_count()) {
        throw InternalError("positions to write do not belong to the mesh");
    }
    const MeshOutput output{mesh, positions, needs_double(mesh, positions, precision)};
    std::string content;
    switch (mesh_format(path)) {
    case MeshFormat::obj:
        content = format_obj(output);
        break;
    case MeshFormat::ply:
        content = format_ply(output);
        break;
    case MeshFormat::stl:
        content = format_stl(output);
        break;
    case MeshFormat::off:
        content = format_off(output);
        break;
    }
    write_file_atomically(path, std::string_view(content));
}

void write_edited_mesh(const std::filesystem::path& path, const Mesh& mesh, std::span<const Vec3> positions,
                       const std::vector<bool>& moved, OutputPrecision precision) {
    if (!has_normals(mesh)) {
        write_mesh(path, mesh, positions, precision);
        return;
    }
    Mesh turned = mesh;
    update_normals(turned, positions, moved);
    write_mesh(path, turned, positions, precision);
}

} // namespace anvil

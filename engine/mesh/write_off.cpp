#include "engine/core/decimal.h"
#include "engine/mesh/mesh_output.h"

namespace anvil {

namespace {

/// Fractions need a point, or they would be read as bytes.
void append_colour(std::string& text, const Column& column, size_t row) {
    text += ' ';
    const size_t begin = text.size();
    append_number(text, column.values[row]);
    if (!is_integer(column.type) && text.find_first_of(".e", begin) == std::string::npos) {
        text += ".0";
    }
}

void append_numbers(std::string& text, const std::vector<const Column*>& columns, size_t row) {
    for (const Column* column : columns) {
        text += ' ';
        append_number(text, column->values[row]);
    }
}

} // namespace

std::string format_off(const MeshOutput& output) {
    const Mesh& mesh = output.mesh;
    std::vector<Column> columns = columns_with_normals(mesh);
    if (find_columns(columns, texture_names).empty()) {
        const std::vector<Column> texture = as_vertex_columns(mesh, mesh.texture_coordinates, texture_names);
        columns.insert(columns.end(), texture.begin(), texture.end());
    }
    const std::vector<const Column*> normals = find_columns(columns, normal_names);
    const std::vector<const Column*> colours = find_columns(columns, colour_names, 1);
    const std::vector<const Column*> texture = find_columns(columns, texture_names);
    const std::vector<const Column*> face_colours = find_columns(mesh.polygon_columns, colour_names, 1);

    std::string text;
    text += texture.empty() ? "" : "ST";
    text += colours.empty() ? "" : "C";
    text += normals.empty() ? "" : "N";
    text += "OFF\n";
    for (const std::string& comment : mesh.comments) {
        text += "# " + comment + '\n';
    }
    text += std::to_string(mesh.vertex_count()) + ' ' + std::to_string(mesh.polygon_count()) + " 0\n";
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        append_position(text, output, v);
        append_numbers(text, normals, v);
        for (const Column* column : colours) {
            append_colour(text, *column, v);
        }
        append_numbers(text, texture, v);
        text += '\n';
    }
    for (size_t f = 0; f < mesh.polygon_count(); ++f) {
        append_number(text, mesh.polygon(f).size());
        for (const uint32_t v : mesh.polygon(f)) {
            text += ' ';
            append_number(text, v);
        }
        for (const Column* column : face_colours) {
            append_colour(text, *column, f);
        }
        text += '\n';
    }
    return text;
}

} // namespace anvil

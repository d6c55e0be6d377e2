#include "engine/core/decimal.h"
#include "engine/mesh/mesh_output.h"

namespace anvil {

namespace {

class ObjWriter {
  public:
    explicit ObjWriter(const MeshOutput& output)
        : output_(output), mesh_(output.mesh), vertex_columns_(columns_with_normals(mesh_)) {}

    std::string write() {
        text_.reserve(40 * mesh_.vertex_count() + 25 * mesh_.polygon_count());
        write_comments();
        write_vertices();
        texture_per_vertex_ = write_pool("vt", mesh_.texture_coordinates, texture_names);
        normal_per_vertex_ = write_pool("vn", mesh_.corner_normals, normal_names);
        write_polygons();
        return std::move(text_);
    }

  private:
    void write_comments();
    void write_vertices();
    bool write_pool(const char* keyword, const CornerLayer& layer, std::span<const char* const> names);
    void write_row(const char* keyword, std::span<const double> numbers);
    void write_polygons();
    void write_corner(size_t corner, uint32_t vertex);

    const MeshOutput& output_;
    const Mesh& mesh_;
    std::vector<Column> vertex_columns_;
    bool texture_per_vertex_ = false;
    bool normal_per_vertex_ = false;
    std::string text_;
};

void ObjWriter::write_comments() {
    for (const std::string& comment : mesh_.comments) {
        const std::string_view text = comment;
        if (text.substr(0, 7) == "mtllib ") {
            text_ += comment;
        } else {
            text_ += "# ";
            text_ += text.substr(0, 8) == "comment " ? text.substr(8) : text;
        }
        text_ += '\n';
    }
}

void ObjWriter::write_vertices() {
    const std::vector<const Column*> colours =
        find_columns(vertex_columns_, std::span(colour_names).first<3>());
    for (size_t v = 0; v < mesh_.vertex_count(); ++v) {
        text_ += "v ";
        append_position(text_, output_, v);
        for (const Column* column : colours) {
            text_ += ' ';
            if (is_integer(column->type)) {
                append_number(text_, static_cast<float>(column->values[v] / 255));
            } else {
                append_number(text_, column->values[v]);
            }
        }
        text_ += '\n';
    }
}

void ObjWriter::write_row(const char* keyword, std::span<const double> numbers) {
    text_ += keyword;
    for (const double number : numbers) {
        text_ += ' ';
        append_number(text_, number);
    }
    text_ += '\n';
}

/// The layer's values or, without a layer, those of vertex columns; true in the latter case.
bool ObjWriter::write_pool(const char* keyword, const CornerLayer& layer,
                           std::span<const char* const> names) {
    if (!layer.empty()) {
        const auto components = static_cast<size_t>(layer.components);
        for (size_t i = 0; i + components <= layer.values.size(); i += components) {
            write_row(keyword, std::span(layer.values).subspan(i, components));
        }
        return false;
    }
    const std::vector<const Column*> columns = find_columns(vertex_columns_, names);
    if (columns.empty()) {
        return false;
    }
    std::vector<double> row(columns.size());
    for (size_t v = 0; v < mesh_.vertex_count(); ++v) {
        for (size_t i = 0; i < row.size(); ++i) {
            row[i] = columns[i]->values[v];
        }
        write_row(keyword, row);
    }
    return true;
}

void ObjWriter::write_corner(size_t corner, uint32_t vertex) {
    const auto index_in = [&](const CornerLayer& layer, bool per_vertex) {
        return per_vertex ? vertex : layer.empty() ? no_index : layer.index[corner];
    };
    const uint32_t texture = index_in(mesh_.texture_coordinates, texture_per_vertex_);
    const uint32_t normal = index_in(mesh_.corner_normals, normal_per_vertex_);
    text_ += ' ';
    append_number(text_, uint64_t{vertex} + 1);
    if (texture != no_index || normal != no_index) {
        text_ += '/';
    }
    if (texture != no_index) {
        append_number(text_, uint64_t{texture} + 1);
    }
    if (normal != no_index) {
        text_ += '/';
        append_number(text_, uint64_t{normal} + 1);
    }
}

void ObjWriter::write_polygons() {
    auto mark = mesh_.groups.begin();
    for (size_t f = 0; f <= mesh_.polygon_count(); ++f) {
        for (; mark != mesh_.groups.end() && mark->first_polygon <= f; ++mark) {
            text_ += mark->keyword + (mark->text.empty() ? "" : " ") + mark->text + '\n';
        }
        if (f == mesh_.polygon_count()) {
            break;
        }
        text_ += 'f';
        for (size_t c = mesh_.polygon_begin[f]; c < mesh_.polygon_begin[f + 1]; ++c) {
            write_corner(c, mesh_.corners[c]);
        }
        text_ += '\n';
    }
}

} // namespace

std::string format_obj(const MeshOutput& output) {
    return ObjWriter(output).write();
}

} // namespace anvil

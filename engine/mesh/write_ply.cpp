#include "engine/mesh/mesh_output.h"
#include "engine/mesh/ply_header.h"

namespace anvil {

namespace {

/// The value as an integer type; what does not fit is clamped.
template <typename T>
void append_integer(std::string& bytes, double value) {
    const double low = std::numeric_limits<T>::lowest();
    const double high = std::numeric_limits<T>::max();
    const double whole = value == value ? std::clamp(std::nearbyint(value), low, high) : 0;
    append_bytes(bytes, static_cast<T>(whole));
}

void append_scalar(std::string& bytes, ScalarType type, double value) {
    switch (type) {
    case ScalarType::int8:
        return append_integer<int8_t>(bytes, value);
    case ScalarType::uint8:
        return append_integer<uint8_t>(bytes, value);
    case ScalarType::int16:
        return append_integer<int16_t>(bytes, value);
    case ScalarType::uint16:
        return append_integer<uint16_t>(bytes, value);
    case ScalarType::int32:
        return append_integer<int32_t>(bytes, value);
    case ScalarType::uint32:
        return append_integer<uint32_t>(bytes, value);
    case ScalarType::float32:
        return append_bytes(bytes, static_cast<float>(value));
    case ScalarType::float64:
        return append_bytes(bytes, value);
    }
}

class PlyWriter {
  public:
    explicit PlyWriter(const MeshOutput& output)
        : output_(output), mesh_(output.mesh), vertex_columns_(columns_with_normals(mesh_)),
          position_type_(output.use_double ? ScalarType::float64 : ScalarType::float32) {
        size_t most = 0;
        for (size_t f = 0; f < mesh_.polygon_count(); ++f) {
            most = std::max(most, mesh_.polygon(f).size());
        }
        // Texture lists have two numbers per corner.
        count_type_ = 2 * most <= 255 ? ScalarType::uint8 : ScalarType::uint32;
        index_type_ = mesh_.vertex_count() <= 0x7fffffff ? ScalarType::int32 : ScalarType::uint32;
    }

    std::string write() {
        bytes_.reserve(40 * mesh_.vertex_count() + 40 * mesh_.polygon_count());
        write_header();
        write_vertices();
        write_polygons();
        return std::move(bytes_);
    }

  private:
    void write_property(ScalarType type, const std::string& name);
    void write_list_property(ScalarType type, const char* name);
    void write_header();
    void write_vertices();
    void write_texture(size_t f);
    void write_polygons();

    const MeshOutput& output_;
    const Mesh& mesh_;
    std::vector<Column> vertex_columns_;
    ScalarType position_type_;
    ScalarType count_type_ = ScalarType::uint8;
    ScalarType index_type_ = ScalarType::int32;
    std::string bytes_;
};

void PlyWriter::write_property(ScalarType type, const std::string& name) {
    bytes_ += std::string("property ") + ply_name(type) + ' ' + name + '\n';
}

void PlyWriter::write_list_property(ScalarType type, const char* name) {
    bytes_ +=
        std::string("property list ") + ply_name(count_type_) + ' ' + ply_name(type) + ' ' + name + '\n';
}

void PlyWriter::write_header() {
    bytes_ += "ply\nformat binary_little_endian 1.0\n";
    for (const std::string& comment : mesh_.comments) {
        const std::string keyword = comment.substr(0, comment.find(' '));
        bytes_ += (keyword == "comment" || keyword == "obj_info" ? "" : "comment ") + comment + '\n';
    }
    bytes_ += "element vertex " + std::to_string(mesh_.vertex_count()) + '\n';
    for (const char* name : {"x", "y", "z"}) {
        write_property(position_type_, name);
    }
    for (const Column& column : vertex_columns_) {
        write_property(column.type, column.name);
    }
    bytes_ += "element face " + std::to_string(mesh_.polygon_count()) + '\n';
    write_list_property(index_type_, "vertex_indices");
    if (!mesh_.texture_coordinates.empty()) {
        write_list_property(ScalarType::float32, "texcoord");
    }
    for (const Column& column : mesh_.polygon_columns) {
        write_property(column.type, column.name);
    }
    bytes_ += "end_header\n";
}

void PlyWriter::write_vertices() {
    for (size_t v = 0; v < mesh_.vertex_count(); ++v) {
        for (int axis = 0; axis < 3; ++axis) {
            append_scalar(bytes_, position_type_, output_.positions[v][axis]);
        }
        for (const Column& column : vertex_columns_) {
            append_scalar(bytes_, column.type, column.values[v]);
        }
    }
}

/// Two numbers per corner; an empty list for polygons that have none.
void PlyWriter::write_texture(size_t f) {
    const CornerLayer& layer = mesh_.texture_coordinates;
    const auto begin = layer.index.begin() + mesh_.polygon_begin[f];
    const auto end = layer.index.begin() + mesh_.polygon_begin[f + 1];
    if (std::all_of(begin, end, [](uint32_t index) { return index == no_index; })) {
        append_scalar(bytes_, count_type_, 0);
        return;
    }
    append_scalar(bytes_, count_type_, 2.0 * static_cast<double>(end - begin));
    for (auto index = begin; index != end; ++index) {
        for (size_t i = 0; i < 2; ++i) {
            const size_t at = *index * static_cast<size_t>(layer.components) + i;
            append_scalar(bytes_, ScalarType::float32, *index == no_index ? 0 : layer.values[at]);
        }
    }
}

void PlyWriter::write_polygons() {
    for (size_t f = 0; f < mesh_.polygon_count(); ++f) {
        const std::span<const uint32_t> polygon = mesh_.polygon(f);
        append_scalar(bytes_, count_type_, static_cast<double>(polygon.size()));
        for (const uint32_t v : polygon) {
            append_bytes(bytes_, v);
        }
        if (!mesh_.texture_coordinates.empty()) {
            write_texture(f);
        }
        for (const Column& column : mesh_.polygon_columns) {
            append_scalar(bytes_, column.type, column.values[f]);
        }
    }
}

} // namespace

std::string format_ply(const MeshOutput& output) {
    return PlyWriter(output).write();
}

} // namespace anvil

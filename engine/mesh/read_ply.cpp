#include "engine/core/number_text.h"
#include "engine/mesh/ply_header.h"
#include "engine/mesh/text_scanner.h"

#include <bit>
#include <cstring>

namespace anvil {

namespace {

/// Numbers of a binary file. Places are byte offsets.
class BinaryData {
  public:
    static constexpr const char* unit = "byte";
    static constexpr bool is_binary = true;

    BinaryData(const MeshSource& source, const PlyHeader& header)
        : source_(source), at_(header.data), swap_((header.format == PlyFormat::binary_big_endian) ==
                                                   (std::endian::native == std::endian::little)) {}

    void begin_element() {}
    size_t place() const { return at_; }
    size_t room(ScalarType type) const { return (source_.text.size() - at_) / size_of(type); }

    double read(ScalarType type) {
        switch (type) {
        case ScalarType::int8:
            return take<int8_t>();
        case ScalarType::uint8:
            return take<uint8_t>();
        case ScalarType::int16:
            return take<int16_t>();
        case ScalarType::uint16:
            return take<uint16_t>();
        case ScalarType::int32:
            return take<int32_t>();
        case ScalarType::uint32:
            return take<uint32_t>();
        case ScalarType::float32:
            return double{take<float>()};
        case ScalarType::float64:
            break;
        }
        return take<double>();
    }

    void skip(ScalarType type, size_t count) { at_ += count * size_of(type); }

    [[noreturn]] void fail(const std::string& cause, const std::string& mend) const {
        source_.fail_at_byte(at_, cause, mend);
    }

  private:
    template <typename T>
    T take() {
        if (source_.text.size() - at_ < sizeof(T)) {
            fail("the file ends within its data", "it is cut off; export the mesh again");
        }
        std::array<char, sizeof(T)> bytes;
        std::memcpy(bytes.data(), source_.text.data() + at_, sizeof(T));
        if (swap_) {
            std::reverse(bytes.begin(), bytes.end());
        }
        at_ += sizeof(T);
        return std::bit_cast<T>(bytes);
    }

    const MeshSource& source_;
    size_t at_;
    bool swap_;
};

/// Numbers of a text file: each element has a line of its own. Places are lines.
class TextData {
  public:
    static constexpr const char* unit = "line";
    static constexpr bool is_binary = false;

    TextData(const MeshSource& source, const PlyHeader& header) : scan_(source, header.data, {}) {}

    void begin_element() {
        if (!scan_.next_line()) {
            fail("the file ends within its data", "it is cut off; export the mesh again");
        }
    }
    size_t place() const { return scan_.line(); }
    size_t room(ScalarType /*type*/) const { return scan_.line_remaining() / 2 + 1; }
    double read(ScalarType /*type*/) { return scan_.number("number"); }
    void skip(ScalarType /*type*/, size_t count) {
        for (size_t i = 0; i < count; ++i) {
            scan_.number("number");
        }
    }
    [[noreturn]] void fail(const std::string& cause, const std::string& mend) const {
        scan_.fail(cause, mend);
    }

  private:
    TextScanner scan_;
};

template <typename Data>
class PlyReader {
  public:
    PlyReader(const MeshSource& source, PlyHeader header)
        : source_(source), header_(std::move(header)), data_(source, header_) {}

    Mesh read();

  private:
    enum class Role { x, y, z, column, corners, texture, skip };

    [[noreturn]] void fail_at(size_t place, const std::string& cause, const std::string& mend) const {
        if constexpr (Data::is_binary) {
            source_.fail_at_byte(place, cause, mend);
        } else {
            source_.fail_at_line(place, cause, mend);
        }
    }
    size_t read_list_count(const PlyProperty& property);
    void skip_element(const PlyElement& element);
    void read_vertices(const PlyElement& element);
    void read_faces(const PlyElement& element);
    std::vector<Role> face_roles(const PlyElement& element);
    void read_corners(const PlyProperty& property);
    void add_face();
    void add_texture_coordinates();

    const MeshSource& source_;
    PlyHeader header_;
    Data data_;
    Mesh mesh_;
    LargestIndex largest_;
    Skipped small_faces_;
    Skipped bad_texture_;
    std::vector<uint32_t> face_;
    std::vector<double> texture_;
    std::vector<double> row_;
    size_t place_ = 0;
};

template <typename Data>
Mesh PlyReader<Data>::read() {
    bool vertices = false;
    bool faces = false;
    for (const PlyElement& element : header_.elements) {
        if (element.name == "vertex" && !vertices) {
            read_vertices(element);
            vertices = true;
        } else if (element.name == "face" && !faces) {
            read_faces(element);
            faces = true;
        } else {
            skip_element(element);
        }
    }
    if (largest_.beyond(mesh_.vertex_count())) {
        fail_at(largest_.place,
                "face refers to vertex " + std::to_string(largest_.index) + " but there are " +
                    std::to_string(mesh_.vertex_count()),
                "indices start at 0; correct the face");
    }
    small_faces_.report(source_, "faces with fewer than three corners left out", Data::unit);
    bad_texture_.report(source_, "faces whose texture coordinates do not match their corners", Data::unit);
    mesh_.comments = header_.comments;
    return std::move(mesh_);
}

template <typename Data>
size_t PlyReader<Data>::read_list_count(const PlyProperty& property) {
    const size_t place = data_.place();
    const double count = data_.read(*property.count_type);
    if (!(count >= 0) || count != std::floor(count) ||
        count > static_cast<double>(data_.room(property.type))) {
        fail_at(place,
                "list '" + property.name + "' of " + number_text(count) +
                    " numbers does not fit what is left of the file",
                "the file is damaged or cut off; export the mesh again");
    }
    return static_cast<size_t>(count);
}

template <typename Data>
void PlyReader<Data>::skip_element(const PlyElement& element) {
    if (element.properties.empty()) {
        return;
    }
    for (uint64_t i = 0; i < element.count; ++i) {
        data_.begin_element();
        for (const PlyProperty& property : element.properties) {
            if (property.count_type) {
                data_.skip(property.type, read_list_count(property));
            } else {
                data_.read(property.type);
            }
        }
    }
}

template <typename Data>
void PlyReader<Data>::read_vertices(const PlyElement& element) {
    constexpr size_t none = SIZE_MAX;
    std::array<size_t, 3> axes = {none, none, none};
    std::vector<size_t> column_of(element.properties.size(), none);
    for (size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (property.count_type) {
            source_.warn("list property '" + property.name + "' of the vertices left out");
        } else if (property.name == "x" || property.name == "y" || property.name == "z") {
            axes[static_cast<size_t>(property.name[0] - 'x')] = i;
            mesh_.double_precision = mesh_.double_precision || property.type == ScalarType::float64;
        } else {
            column_of[i] = mesh_.vertex_columns.size();
            mesh_.vertex_columns.push_back({property.name, property.type, {}});
            mesh_.vertex_columns.back().values.reserve(element.count);
        }
    }
    if (std::find(axes.begin(), axes.end(), none) != axes.end()) {
        source_.fail_at_line(element.line, "the vertices lack x, y or z", "export positions as x, y and z");
    }
    mesh_.positions.reserve(element.count);
    row_.resize(element.properties.size());
    for (uint64_t v = 0; v < element.count; ++v) {
        data_.begin_element();
        for (size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (property.count_type) {
                data_.skip(property.type, read_list_count(property));
                continue;
            }
            const size_t place = data_.place();
            row_[i] = data_.read(property.type);
            if (column_of[i] != none) {
                mesh_.vertex_columns[column_of[i]].values.push_back(row_[i]);
            } else if (!(std::abs(row_[i]) <= largest_accepted_coordinate)) {
                fail_at(place,
                        property.name + " " + rounded_text(row_[i]) + " of vertex " + std::to_string(v) +
                            " is not a finite number up to 1e36",
                        "correct the position");
            }
        }
        mesh_.positions.emplace_back(row_[axes[0]], row_[axes[1]], row_[axes[2]]);
    }
}

template <typename Data>
std::vector<typename PlyReader<Data>::Role> PlyReader<Data>::face_roles(const PlyElement& element) {
    std::vector<Role> roles;
    bool corners = false;
    bool texture = false;
    for (const PlyProperty& property : element.properties) {
        const bool indices = property.name == "vertex_indices" || property.name == "vertex_index";
        if (!property.count_type) {
            roles.push_back(Role::column);
            mesh_.polygon_columns.push_back({property.name, property.type, {}});
            mesh_.polygon_columns.back().values.reserve(element.count);
        } else if (indices && !corners) {
            roles.push_back(Role::corners);
            corners = true;
        } else if (property.name == "texcoord" && !texture) {
            roles.push_back(Role::texture);
            texture = true;
        } else {
            roles.push_back(Role::skip);
            source_.warn("list property '" + property.name + "' of the faces left out");
        }
    }
    if (!corners) {
        source_.fail_at_line(element.line, "the faces have no list vertex_indices",
                             "export the faces' corners");
    }
    return roles;
}

template <typename Data>
void PlyReader<Data>::read_faces(const PlyElement& element) {
    const std::vector<Role> roles = face_roles(element);
    mesh_.polygon_begin.reserve(element.count + 1);
    for (uint64_t f = 0; f < element.count; ++f) {
        data_.begin_element();
        place_ = data_.place();
        row_.clear();
        face_.clear();
        texture_.clear();
        for (size_t i = 0; i < roles.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (roles[i] == Role::column) {
                row_.push_back(data_.read(property.type));
            } else if (roles[i] == Role::corners) {
                read_corners(property);
            } else if (roles[i] == Role::texture) {
                texture_.resize(read_list_count(property));
                std::generate(texture_.begin(), texture_.end(), [&] { return data_.read(property.type); });
            } else {
                data_.skip(property.type, read_list_count(property));
            }
        }
        add_face();
    }
}

template <typename Data>
void PlyReader<Data>::read_corners(const PlyProperty& property) {
    const size_t count = read_list_count(property);
    for (size_t i = 0; i < count; ++i) {
        const double index = data_.read(property.type);
        if (!(index >= 0) || index != std::floor(index) || index >= no_index) {
            fail_at(place_, "'" + number_text(index) + "' is no vertex index",
                    "indices are integers from 0 on");
        }
        face_.push_back(static_cast<uint32_t>(index));
        largest_.see(face_.back(), place_);
    }
}

template <typename Data>
void PlyReader<Data>::add_face() {
    if (face_.size() < 3) {
        small_faces_.add(place_);
        return;
    }
    for (size_t i = 0; i < row_.size(); ++i) {
        mesh_.polygon_columns[i].values.push_back(row_[i]);
    }
    add_texture_coordinates();
    mesh_.add_polygon(face_);
}

/// A list of two numbers per corner; the layer stays empty until a face has one.
template <typename Data>
void PlyReader<Data>::add_texture_coordinates() {
    CornerLayer& layer = mesh_.texture_coordinates;
    const bool fits = texture_.size() == 2 * face_.size();
    if (!fits && !texture_.empty()) {
        bad_texture_.add(place_);
    }
    if (fits && layer.index.empty()) {
        layer.components = 2;
        layer.index.assign(mesh_.corners.size(), no_index);
    }
    if (fits) {
        for (size_t i = 0; i < face_.size(); ++i) {
            layer.index.push_back(static_cast<uint32_t>(layer.values.size() / 2));
            layer.values.insert(layer.values.end(), {texture_[2 * i], texture_[2 * i + 1]});
        }
    } else if (!layer.index.empty()) {
        layer.index.insert(layer.index.end(), face_.size(), no_index);
    }
}

} // namespace

Mesh read_ply(const MeshSource& source) {
    PlyHeader header = read_ply_header(source);
    if (header.format == PlyFormat::ascii) {
        return PlyReader<TextData>(source, std::move(header)).read();
    }
    return PlyReader<BinaryData>(source, std::move(header)).read();
}

} // namespace anvil

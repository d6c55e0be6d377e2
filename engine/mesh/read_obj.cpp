#include "engine/mesh/text_scanner.h"

#include <charconv>

namespace anvil {

namespace {

/// One of the three pools that face corners refer to.
struct Pool {
    const char* name;
    size_t count = 0;
    LargestIndex largest;
};

class ObjReader {
  public:
    explicit ObjReader(const MeshSource& source)
        : source_(source), scan_(source, byte_order_mark(source.text), {'#', true}) {}

    Mesh read();

  private:
    static size_t byte_order_mark(std::string_view text) {
        return text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;
    }

    void read_statement(std::string_view keyword);
    void read_vertex();
    void read_colour(const double* rgb);
    void read_texture_coordinate();
    void read_normal();
    void read_face();
    uint32_t read_index(const char*& at, const char* end, Pool& pool);
    void read_corner(std::string_view word);
    void finish_layer(CornerLayer& layer, Pool& pool);
    [[noreturn]] void fail_corner(const char* begin, const char* end);

    const MeshSource& source_;
    TextScanner scan_;
    Mesh mesh_;
    Pool vertices_{"vertex", 0, {}};
    Pool textures_{"texture coordinate", 0, {}};
    Pool normals_{"normal", 0, {}};
    bool third_texture_number_ = false;
    std::vector<uint32_t> face_;
    std::vector<uint32_t> face_textures_;
    std::vector<uint32_t> face_normals_;
    Skipped small_faces_;
    Skipped ignored_;
    Skipped bad_attributes_;
};

Mesh ObjReader::read() {
    const size_t zero = source_.text.find('\0');
    if (zero != std::string_view::npos) {
        source_.fail_at_byte(zero, "a zero byte: this is not an OBJ text file",
                             "check what kind of file it is");
    }
    while (scan_.next_line()) {
        read_statement(scan_.word());
    }
    if (vertices_.largest.beyond(vertices_.count)) {
        source_.fail_at_line(vertices_.largest.place,
                             "face refers to vertex " +
                                 std::to_string(uint64_t{vertices_.largest.index} + 1) +
                                 " but the file has " + std::to_string(vertices_.count),
                             "correct the face or add the vertex");
    }
    finish_layer(mesh_.texture_coordinates, textures_);
    finish_layer(mesh_.corner_normals, normals_);
    mesh_.texture_coordinates.components = 3;
    mesh_.corner_normals.components = 3;
    if (!third_texture_number_) {
        std::vector<double>& values = mesh_.texture_coordinates.values;
        for (size_t i = 0; i < values.size() / 3; ++i) {
            values[2 * i] = values[3 * i];
            values[2 * i + 1] = values[3 * i + 1];
        }
        values.resize(values.size() / 3 * 2);
        mesh_.texture_coordinates.components = 2;
    }
    small_faces_.report(source_, "faces with fewer than three corners left out");
    ignored_.report(source_, "statements that Anvil does not use left out");
    bad_attributes_.report(source_, "texture coordinates or normals that are missing or not finite");
    return std::move(mesh_);
}

void ObjReader::read_statement(std::string_view keyword) {
    if (keyword == "v") {
        read_vertex();
    } else if (keyword == "f" || keyword == "fo") {
        read_face();
    } else if (keyword == "vn") {
        read_normal();
    } else if (keyword == "vt") {
        read_texture_coordinate();
    } else if (keyword == "g" || keyword == "o" || keyword == "s" || keyword == "usemtl") {
        const auto polygon = static_cast<uint32_t>(mesh_.polygon_count());
        mesh_.groups.push_back({polygon, std::string(keyword), std::string(scan_.rest())});
    } else if (keyword == "mtllib") {
        mesh_.comments.push_back("mtllib " + std::string(scan_.rest()));
    } else {
        ignored_.add(scan_.line());
    }
}

void ObjReader::read_vertex() {
    Vec3 p;
    p.x = scan_.coordinate("x coordinate");
    p.y = scan_.coordinate("y coordinate");
    p.z = scan_.coordinate("z coordinate");
    // After x y z: nothing, w, r g b, or w r g b.
    std::array<double, 4> more{};
    size_t count = 0;
    while (count < more.size() && !scan_.line_done()) {
        more[count++] = scan_.number("vertex colour");
    }
    if (count >= 3) {
        read_colour(more.data() + (count - 3));
    } else if (!mesh_.vertex_columns.empty()) {
        const std::array<double, 3> white = {1, 1, 1};
        read_colour(white.data());
    }
    mesh_.positions.push_back(p);
    ++vertices_.count;
}

void ObjReader::read_colour(const double* rgb) {
    if (mesh_.vertex_columns.empty()) {
        for (const char* name : {"red", "green", "blue"}) {
            mesh_.vertex_columns.push_back(
                {name, ScalarType::float32, std::vector<double>(mesh_.positions.size(), 1.0)});
        }
    }
    for (size_t i = 0; i < 3; ++i) {
        mesh_.vertex_columns[i].values.push_back(rgb[i]);
    }
}

void ObjReader::read_texture_coordinate() {
    std::array<double, 3> uvw{};
    uvw[0] = scan_.number("texture coordinate");
    for (size_t i = 1; i < 3 && !scan_.line_done(); ++i) {
        uvw[i] = scan_.number("texture coordinate");
        third_texture_number_ = third_texture_number_ || (i == 2 && uvw[i] != 0);
    }
    for (double& value : uvw) {
        if (!std::isfinite(value)) {
            bad_attributes_.add(scan_.line());
            value = 0;
        }
        mesh_.texture_coordinates.values.push_back(value);
    }
    ++textures_.count;
}

void ObjReader::read_normal() {
    Vec3 n;
    n.x = scan_.number("normal");
    n.y = scan_.number("normal");
    n.z = scan_.number("normal");
    if (!is_finite(n)) {
        bad_attributes_.add(scan_.line());
        n = Vec3{0};
    }
    mesh_.corner_normals.values.insert(mesh_.corner_normals.values.end(), {n.x, n.y, n.z});
    ++normals_.count;
}

void ObjReader::fail_corner(const char* begin, const char* end) {
    const std::string found(begin, std::min(end, begin + 40));
    scan_.fail("face corner '" + found + "' is not of the form v, v/vt, v//vn or v/vt/vn",
               "write indices from 1, or negative ones that count back");
}

/// One index at `at`, which moves behind it; 0-based.
uint32_t ObjReader::read_index(const char*& at, const char* end, Pool& pool) {
    long long value = 0;
    const std::from_chars_result result = std::from_chars(at, end, value);
    const bool overflow = result.ec == std::errc::result_out_of_range;
    if (result.ec != std::errc() && !overflow) {
        fail_corner(at, end);
    }
    const long long index = value > 0 ? value - 1 : static_cast<long long>(pool.count) + value;
    if (overflow || value == 0 || index < 0 || index >= no_index) {
        scan_.fail("there is no " + std::string(pool.name) + " " + std::string(at, result.ptr) + " (" +
                       std::to_string(pool.count) + " so far)",
                   "indices start at 1, negative ones count back from the last");
    }
    at = result.ptr;
    pool.largest.see(static_cast<uint32_t>(index), scan_.line());
    return static_cast<uint32_t>(index);
}

void ObjReader::read_corner(std::string_view word) {
    const char* at = word.data();
    const char* end = at + word.size();
    uint32_t texture = no_index;
    uint32_t normal = no_index;
    face_.push_back(read_index(at, end, vertices_));
    if (at != end && *at == '/') {
        ++at;
        if (at != end && *at != '/') {
            texture = read_index(at, end, textures_);
        }
        if (at != end && *at == '/' && ++at != end) {
            normal = read_index(at, end, normals_);
        }
    }
    if (at != end) {
        fail_corner(word.data(), end);
    }
    face_textures_.push_back(texture);
    face_normals_.push_back(normal);
}

/// Appends a face's indices to a layer that stays empty until a face has one.
void append_layer(CornerLayer& layer, const std::vector<uint32_t>& indices, size_t corners_before) {
    const bool any = std::any_of(indices.begin(), indices.end(), [](uint32_t i) { return i != no_index; });
    if (layer.index.empty() && any) {
        layer.index.assign(corners_before, no_index);
    }
    if (!layer.index.empty() || any) {
        layer.index.insert(layer.index.end(), indices.begin(), indices.end());
    }
}

void ObjReader::read_face() {
    face_.clear();
    face_textures_.clear();
    face_normals_.clear();
    for (std::string_view word = scan_.word(); !word.empty(); word = scan_.word()) {
        read_corner(word);
    }
    if (face_.size() < 3) {
        small_faces_.add(scan_.line());
        return;
    }
    append_layer(mesh_.texture_coordinates, face_textures_, mesh_.corners.size());
    append_layer(mesh_.corner_normals, face_normals_, mesh_.corners.size());
    mesh_.add_polygon(face_);
}

/// Drops indices beyond the pool: a wrong texture index is no reason to refuse the shape.
void ObjReader::finish_layer(CornerLayer& layer, Pool& pool) {
    if (!pool.largest.beyond(pool.count)) {
        return;
    }
    bad_attributes_.add(pool.largest.place);
    for (uint32_t& index : layer.index) {
        index = index < pool.count ? index : no_index;
    }
}

} // namespace

Mesh read_obj(const MeshSource& source) {
    return ObjReader(source).read();
}

} // namespace anvil

#include "engine/mesh/mesh_output.h"
#include "engine/mesh/text_scanner.h"

namespace anvil {

namespace {

struct OffHeader {
    bool texture = false;
    bool colour = false;
    bool normal = false;
    size_t vertices = 0;
    size_t faces = 0;
};

class OffReader {
  public:
    explicit OffReader(const MeshSource& source)
        : source_(source), scan_(source, source.text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0, {'#', false}) {}

    Mesh read() {
        read_header();
        read_vertices();
        read_faces();
        return std::move(mesh_);
    }

  private:
    void read_keyword();
    void read_header();
    size_t read_count(const char* what, size_t least_bytes);
    void add_vertex_columns();
    void read_vertices();
    void read_vertex_attributes(bool first);
    void read_faces();
    double read_colour_number(bool& fractional);
    void read_face_colour();
    void keep_face_colours();

    const MeshSource& source_;
    TextScanner scan_;
    OffHeader header_;
    Mesh mesh_;
    size_t colour_numbers_ = 0; ///< per vertex
    std::vector<uint32_t> face_;
    std::vector<std::array<double, 4>> face_colours_;
    std::vector<size_t> face_colour_numbers_;
    bool fractional_face_colours_ = false;
    bool fractional_vertex_colours_ = false;
    std::vector<double> row_;
    std::vector<bool> row_fractional_;
};

void OffReader::read_keyword() {
    const std::string_view word = scan_.word_anywhere();
    std::string_view prefix = word;
    const auto take = [&prefix](std::string_view letters) {
        const bool found = prefix.substr(0, letters.size()) == letters;
        prefix.remove_prefix(found ? letters.size() : 0);
        return found;
    };
    header_.texture = take("ST");
    header_.colour = take("C");
    header_.normal = take("N");
    header_.colour = header_.colour || take("C");
    if (prefix != "OFF") {
        source_.fail_at_line(std::max<size_t>(scan_.line(), 1),
                             "'" + std::string(word.substr(0, 40)) + "' is not OFF, COFF, NOFF or STOFF",
                             "check what kind of file it is");
    }
}

size_t OffReader::read_count(const char* what, size_t least_bytes) {
    if (scan_.line_done() && !scan_.next_line()) {
        scan_.fail(std::string(what) + " is missing", "the file is cut off; export the mesh again");
    }
    const long long count = scan_.integer(what);
    if (count < 0 || static_cast<size_t>(count) > scan_.remaining() / least_bytes + 1) {
        scan_.fail(std::string(what) + " " + std::to_string(count) + " does not fit the file, which has " +
                       std::to_string(scan_.remaining()) + " bytes more",
                   "the file is damaged or cut off; export the mesh again");
    }
    return static_cast<size_t>(count);
}

void OffReader::read_header() {
    read_keyword();
    if (scan_.peek_word() == "BINARY") {
        scan_.fail("binary OFF files are not supported", "export as text, or as PLY");
    }
    header_.vertices = read_count("number of vertices", 6);
    header_.faces = read_count("number of faces", 2);
}

void OffReader::add_vertex_columns() {
    const auto add = [this](const char* name, ScalarType type) {
        mesh_.vertex_columns.push_back({name, type, {}});
        mesh_.vertex_columns.back().values.reserve(header_.vertices);
    };
    if (header_.normal) {
        add("nx", ScalarType::float32);
        add("ny", ScalarType::float32);
        add("nz", ScalarType::float32);
    }
    for (size_t i = 0; i < colour_numbers_; ++i) {
        add(colour_names[i], ScalarType::uint8);
    }
    if (header_.texture) {
        add("s", ScalarType::float32);
        add("t", ScalarType::float32);
    }
}

void OffReader::read_vertices() {
    mesh_.positions.reserve(header_.vertices);
    for (size_t v = 0; v < header_.vertices; ++v) {
        if (!scan_.next_line()) {
            scan_.fail("the file ends after " + std::to_string(v) + " of " +
                           std::to_string(header_.vertices) + " vertices",
                       "it is cut off; export the mesh again");
        }
        Vec3 p;
        p.x = scan_.coordinate("x coordinate");
        p.y = scan_.coordinate("y coordinate");
        p.z = scan_.coordinate("z coordinate");
        mesh_.positions.push_back(p);
        read_vertex_attributes(v == 0);
    }
    for (Column& column : mesh_.vertex_columns) {
        const bool fraction = column.type == ScalarType::uint8 && fractional_vertex_colours_;
        column.type = fraction ? ScalarType::float32 : column.type;
    }
}

/// The first vertex tells how many numbers a colour has.
void OffReader::read_vertex_attributes(bool first) {
    row_.clear();
    row_fractional_.clear();
    const size_t normal = header_.normal ? 3 : 0;
    const size_t texture = header_.texture ? 2 : 0;
    while (!scan_.line_done() && row_.size() < 16) {
        bool fractional = false;
        row_.push_back(read_colour_number(fractional));
        row_fractional_.push_back(fractional);
    }
    if (first) {
        const bool any = header_.colour && row_.size() >= normal + texture + 3;
        colour_numbers_ = any ? std::min<size_t>(row_.size() - normal - texture, 4) : 0;
        add_vertex_columns();
    }
    row_.resize(mesh_.vertex_columns.size(), 0);
    for (size_t i = 0; i < row_.size(); ++i) {
        mesh_.vertex_columns[i].values.push_back(row_[i]);
    }
    for (size_t i = normal; i < std::min(normal + colour_numbers_, row_fractional_.size()); ++i) {
        fractional_vertex_colours_ = fractional_vertex_colours_ || row_fractional_[i];
    }
}

/// Colours are bytes or, where any of them has a point, fractions.
double OffReader::read_colour_number(bool& fractional) {
    fractional = fractional || scan_.peek_word().find_first_of(".eE") != std::string_view::npos;
    const double value = scan_.number("colour");
    fractional = fractional || value < 0 || value > 255;
    return value;
}

void OffReader::read_face_colour() {
    std::array<double, 4> colour = {0, 0, 0, 0};
    size_t count = 0;
    while (count < colour.size() && !scan_.line_done()) {
        colour[count++] = read_colour_number(fractional_face_colours_);
    }
    face_colours_.push_back(colour);
    face_colour_numbers_.push_back(count);
}

void OffReader::read_faces() {
    Skipped small;
    for (size_t f = 0; f < header_.faces; ++f) {
        if (!scan_.next_line()) {
            scan_.fail("the file ends after " + std::to_string(f) + " of " + std::to_string(header_.faces) +
                           " faces",
                       "it is cut off; export the mesh again");
        }
        const long long count = scan_.integer("number of corners");
        if (count < 0 || static_cast<size_t>(count) > scan_.line_remaining()) {
            scan_.fail("number of corners " + std::to_string(count) + " does not fit the line",
                       "correct the face");
        }
        face_.clear();
        for (long long i = 0; i < count; ++i) {
            const long long index = scan_.integer("vertex index");
            if (index < 0 || static_cast<size_t>(index) >= header_.vertices) {
                scan_.fail("there is no vertex " + std::to_string(index) + " (the file has 0 to " +
                               std::to_string(static_cast<long long>(header_.vertices) - 1) + ")",
                           "correct the face or add the vertex");
            }
            face_.push_back(static_cast<uint32_t>(index));
        }
        if (count < 3) {
            small.add(scan_.line());
            continue;
        }
        mesh_.add_polygon(face_);
        read_face_colour();
    }
    small.report(source_, "faces with fewer than three corners left out");
    keep_face_colours();
}

/// Columns hold one number for every polygon, so colours are kept where all polygons have as many numbers.
void OffReader::keep_face_colours() {
    const auto [least, most] = std::minmax_element(face_colour_numbers_.begin(), face_colour_numbers_.end());
    if (face_colour_numbers_.empty() || *most == 0) {
        return;
    }
    if (*least != *most || *most < 3) {
        source_.warn("face colours left out: not every face has one of three or four numbers");
        return;
    }
    const ScalarType type = fractional_face_colours_ ? ScalarType::float32 : ScalarType::uint8;
    for (size_t i = 0; i < *most; ++i) {
        Column column{colour_names[i], type, {}};
        for (const std::array<double, 4>& colour : face_colours_) {
            column.values.push_back(colour[i]);
        }
        mesh_.polygon_columns.push_back(std::move(column));
    }
}

} // namespace

Mesh read_off(const MeshSource& source) {
    return OffReader(source).read();
}

} // namespace anvil

#include "engine/mesh/text_scanner.h"
#include "engine/mesh/weld.h"

#include <bit>
#include <cstring>

namespace anvil {

namespace {

constexpr size_t header_size = 80;
constexpr size_t record_size = 50;

bool same_word(std::string_view word, std::string_view lower) {
    return word.size() == lower.size() &&
           std::equal(word.begin(), word.end(), lower.begin(), [](char a, char b) {
               return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
           });
}

/// Little-endian number at a byte.
template <typename T>
T number_at(std::string_view bytes, size_t at) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes.data() + at, sizeof(T));
    if constexpr (std::endian::native == std::endian::big) {
        std::reverse(raw.begin(), raw.end());
    }
    return std::bit_cast<T>(raw);
}

/// Gives equal positions one vertex, in the order of first occurrence.
void weld(Mesh& mesh) {
    const std::vector<uint32_t> first = first_equal(mesh.positions);
    std::vector<uint32_t> index(first.size());
    std::vector<Vec3> kept;
    for (size_t i = 0; i < first.size(); ++i) {
        if (first[i] == i) {
            index[i] = static_cast<uint32_t>(kept.size());
            kept.push_back(mesh.positions[i]);
        } else {
            index[i] = index[first[i]];
        }
    }
    mesh.positions = std::move(kept);
    for (uint32_t& corner : mesh.corners) {
        corner = index[corner];
    }
}

class TextStl {
  public:
    explicit TextStl(const MeshSource& source) : source_(source), scan_(source, start(source.text), {}) {}

    Mesh read();

  private:
    static size_t start(std::string_view text) { return text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0; }

    void expect(std::string_view wanted);
    void read_facet();
    void add_vertex();

    const MeshSource& source_;
    TextScanner scan_;
    Mesh mesh_;
    Skipped small_faces_;
};

Mesh TextStl::read() {
    bool open = false;
    while (true) {
        const std::string_view word = scan_.word_anywhere();
        if (word.empty()) {
            break;
        }
        if (same_word(word, "solid")) {
            open = true;
            const std::string_view name = scan_.rest();
            if (mesh_.comments.empty() && !name.empty()) {
                mesh_.comments.push_back("solid " + std::string(name));
            }
        } else if (same_word(word, "endsolid")) {
            open = false;
            scan_.rest();
        } else if (same_word(word, "facet")) {
            read_facet();
        } else {
            scan_.fail("'" + std::string(word.substr(0, 40)) + "' where facet or endsolid belongs",
                       "correct the line");
        }
    }
    if (open) {
        source_.warn("the file has no endsolid line; it may be cut off");
    }
    small_faces_.report(source_, "faces with fewer than three corners left out");
    weld(mesh_);
    return std::move(mesh_);
}

void TextStl::expect(std::string_view wanted) {
    const std::string_view word = scan_.word_anywhere();
    if (word.empty()) {
        scan_.fail("the file ends inside a facet", "it is cut off; export the mesh again");
    }
    if (!same_word(word, wanted)) {
        scan_.fail("'" + std::string(word.substr(0, 40)) + "' where " + std::string(wanted) + " belongs",
                   "correct the line");
    }
}

void TextStl::read_facet() {
    const size_t line = scan_.line();
    if (same_word(scan_.peek_word(), "normal")) {
        scan_.word();
        for (int i = 0; i < 3; ++i) {
            scan_.word();
        }
    }
    expect("outer");
    expect("loop");
    std::vector<uint32_t> face;
    std::string_view word = scan_.word_anywhere();
    for (; same_word(word, "vertex"); word = scan_.word_anywhere()) {
        face.push_back(static_cast<uint32_t>(mesh_.positions.size()));
        add_vertex();
    }
    if (!same_word(word, "endloop")) {
        scan_.fail(word.empty() ? "the file ends inside a facet"
                                : "'" + std::string(word.substr(0, 40)) + "' where vertex or endloop belongs",
                   word.empty() ? "it is cut off; export the mesh again" : "correct the line");
    }
    expect("endfacet");
    if (face.size() >= 3) {
        mesh_.add_polygon(face);
    } else {
        small_faces_.add(line);
    }
}

void TextStl::add_vertex() {
    Vec3 p;
    p.x = scan_.coordinate("x coordinate");
    p.y = scan_.coordinate("y coordinate");
    p.z = scan_.coordinate("z coordinate");
    mesh_.positions.push_back(p);
}

/// The number of facets, after comparing what the header says with the file's size.
size_t count_records(const MeshSource& source) {
    const std::string_view bytes = source.text;
    if (bytes.size() < header_size + 4) {
        source.fail("the file is neither a text STL nor long enough for a binary one (84 bytes)",
                    "it is cut off or of another kind; export the mesh again");
    }
    const size_t announced = number_at<uint32_t>(bytes, header_size);
    const size_t data = bytes.size() - header_size - 4;
    const size_t present = data / record_size;
    if (announced > present) {
        source.fail_at_byte(header_size,
                            "the header announces " + std::to_string(announced) + " facets, but " +
                                std::to_string(present) + " follow",
                            "the file is damaged or cut off; export the mesh again");
    }
    if (announced * record_size == data) {
        return announced;
    }
    // Some programs stream facets and never correct the count: whole records are taken to be facets.
    const bool whole = data % record_size == 0;
    source.warn("the header announces " + std::to_string(announced) + " facets, but " + std::to_string(data) +
                " bytes of data follow (50 per facet): " + std::to_string(whole ? present : announced) +
                " facets read");
    return whole ? present : announced;
}

Mesh read_binary(const MeshSource& source) {
    const size_t count = count_records(source);
    Mesh mesh;
    mesh.positions.reserve(3 * count);
    Column attribute{"attribute", ScalarType::uint16, std::vector<double>(count)};
    bool any_attribute = false;
    for (size_t f = 0; f < count; ++f) {
        const size_t record = header_size + 4 + f * record_size;
        for (size_t k = 0; k < 3; ++k) {
            const size_t at = record + 12 * (k + 1);
            const Vec3 p(number_at<float>(source.text, at), number_at<float>(source.text, at + 4),
                         number_at<float>(source.text, at + 8));
            const Vec3 size = glm::abs(p);
            if (!(size.x + size.y + size.z <= largest_accepted_coordinate)) {
                source.fail_at_byte(
                    at, "a coordinate of facet " + std::to_string(f) + " is not finite or above 1e36",
                    "correct the position");
            }
            mesh.positions.push_back(p);
        }
        const auto first = static_cast<uint32_t>(3 * f);
        mesh.add_polygon(std::array<uint32_t, 3>{first, first + 1, first + 2});
        attribute.values[f] = number_at<uint16_t>(source.text, record + 48);
        any_attribute = any_attribute || attribute.values[f] != 0;
    }
    weld(mesh);
    if (any_attribute) {
        mesh.polygon_columns.push_back(std::move(attribute));
    }
    return mesh;
}

/// Binary headers may begin with "solid" too: a size that fits the count, or a zero byte near the start,
/// tells.
bool is_text(std::string_view bytes) {
    const size_t begin = bytes.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;
    const size_t word = std::min(bytes.find_first_not_of(" \t\r\n", begin), bytes.size());
    if (!same_word(bytes.substr(word, 5), "solid")) {
        return false;
    }
    if (bytes.size() >= header_size + 4 &&
        bytes.size() == header_size + 4 + record_size * number_at<uint32_t>(bytes, header_size)) {
        return false;
    }
    return bytes.substr(0, 512).find('\0') == std::string_view::npos;
}

} // namespace

Mesh read_stl(const MeshSource& source) {
    return is_text(source.text) ? TextStl(source).read() : read_binary(source);
}

} // namespace anvil

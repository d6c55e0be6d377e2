#include "engine/mesh/ply_header.h"

#include "engine/mesh/text_scanner.h"

namespace anvil {

namespace {

struct TypeName {
    const char* old_name;
    const char* new_name;
    ScalarType type;
    size_t size;
};

constexpr std::array<TypeName, 8> types = {{{"char", "int8", ScalarType::int8, 1},
                                            {"uchar", "uint8", ScalarType::uint8, 1},
                                            {"short", "int16", ScalarType::int16, 2},
                                            {"ushort", "uint16", ScalarType::uint16, 2},
                                            {"int", "int32", ScalarType::int32, 4},
                                            {"uint", "uint32", ScalarType::uint32, 4},
                                            {"float", "float32", ScalarType::float32, 4},
                                            {"double", "float64", ScalarType::float64, 8}}};

class HeaderReader {
  public:
    explicit HeaderReader(const MeshSource& source) : source_(source), scan_(source, 0, {}) {}

    PlyHeader read();

  private:
    bool read_line(std::string_view keyword);
    void read_format();
    void read_element();
    void read_property();
    ScalarType read_type();
    std::string read_name();
    void check_sizes();

    const MeshSource& source_;
    TextScanner scan_;
    PlyHeader header_;
    bool has_format_ = false;
};

PlyHeader HeaderReader::read() {
    if (!scan_.next_line() || scan_.word() != "ply") {
        source_.fail("the file does not begin with 'ply'", "check what kind of file it is");
    }
    do {
        if (!scan_.next_line()) {
            scan_.fail("the header has no end_header line", "the file is cut off; export the mesh again");
        }
    } while (read_line(scan_.word()));
    if (!has_format_) {
        source_.fail("the header has no format line", "add 'format ascii 1.0' or what the data is");
    }
    header_.data = source_.text.size() - scan_.remaining();
    check_sizes();
    return std::move(header_);
}

bool HeaderReader::read_line(std::string_view keyword) {
    if (keyword == "end_header") {
        return false;
    }
    if (keyword == "format") {
        read_format();
    } else if (keyword == "element") {
        read_element();
    } else if (keyword == "property") {
        read_property();
    } else if (keyword == "comment" || keyword == "obj_info") {
        const std::string_view text = scan_.rest();
        header_.comments.push_back(std::string(keyword) + (text.empty() ? "" : " ") + std::string(text));
    } else {
        scan_.fail("'" + std::string(keyword.substr(0, 40)) + "' does not belong in a PLY header",
                   "write element, property, comment or end_header");
    }
    return true;
}

void HeaderReader::read_format() {
    const std::string_view name = scan_.word();
    has_format_ = true;
    if (name == "ascii") {
        header_.format = PlyFormat::ascii;
    } else if (name == "binary_little_endian") {
        header_.format = PlyFormat::binary_little_endian;
    } else if (name == "binary_big_endian") {
        header_.format = PlyFormat::binary_big_endian;
    } else {
        scan_.fail("unknown format '" + std::string(name.substr(0, 40)) + "'",
                   "write ascii, binary_little_endian or binary_big_endian");
    }
}

std::string HeaderReader::read_name() {
    const std::string_view name = scan_.word();
    if (name.empty()) {
        scan_.fail("a name is missing", "complete the line");
    }
    return std::string(name);
}

void HeaderReader::read_element() {
    PlyElement element;
    element.name = read_name();
    element.line = scan_.line();
    const long long count = scan_.integer("element count");
    if (count < 0) {
        scan_.fail("element count " + std::to_string(count) + " is negative", "correct the header");
    }
    element.count = static_cast<uint64_t>(count);
    header_.elements.push_back(std::move(element));
}

ScalarType HeaderReader::read_type() {
    const std::string_view name = scan_.word();
    for (const TypeName& known : types) {
        if (name == known.old_name || name == known.new_name) {
            return known.type;
        }
    }
    scan_.fail("unknown type '" + std::string(name.substr(0, 40)) + "'",
               "PLY has char, uchar, short, ushort, int, uint, float and double");
}

void HeaderReader::read_property() {
    if (header_.elements.empty()) {
        scan_.fail("a property before the first element", "correct the header");
    }
    PlyProperty property;
    if (scan_.peek_word() == "list") {
        scan_.word();
        property.count_type = read_type();
    }
    property.type = read_type();
    property.name = read_name();
    header_.elements.back().properties.push_back(std::move(property));
}

/// Elements that could not all be in the rest of the file are refused before memory is taken for them.
void HeaderReader::check_sizes() {
    const uint64_t left = source_.text.size() - header_.data;
    for (const PlyElement& element : header_.elements) {
        uint64_t least = 0;
        for (const PlyProperty& property : element.properties) {
            const bool text = header_.format == PlyFormat::ascii;
            least += text ? 2 : size_of(property.count_type.value_or(property.type));
        }
        // The last number of a text file needs no separator.
        if (least > 0 && element.count > (left + 1) / least) {
            source_.fail_at_line(element.line,
                                 "the header announces " + std::to_string(element.count) + " elements '" +
                                     element.name + "', but only " + std::to_string(left) +
                                     " bytes of data follow",
                                 "the file is damaged or cut off; export the mesh again");
        }
    }
}

} // namespace

PlyHeader read_ply_header(const MeshSource& source) {
    return HeaderReader(source).read();
}

size_t size_of(ScalarType type) {
    return types[static_cast<size_t>(type)].size;
}

const char* ply_name(ScalarType type) {
    return types[static_cast<size_t>(type)].old_name;
}

} // namespace anvil

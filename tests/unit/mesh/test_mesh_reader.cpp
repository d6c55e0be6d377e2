#include "engine/core/error.h"
#include "engine/mesh/health.h"
#include "engine/mesh/mesh_reader.h"

#include "tests/support/comma_locale.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

using namespace anvil;
namespace fs = std::filesystem;

namespace {

constexpr const char* cube_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
                                 "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

std::string content_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Reads a text as a file of that name.
Mesh read_text(const std::string& name, const std::string& text, Log& log) {
    const ScratchFolder folder;
    const fs::path path = folder / name;
    std::ofstream(path, std::ios::binary) << text;
    return read_mesh(path, log);
}

std::string error_of(const std::string& name, const std::string& text) {
    Log log;
    try {
        read_text(name, text, log);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

void check_valid(const Mesh& mesh) {
    REQUIRE(mesh.polygon_begin.back() == mesh.corners.size());
    CHECK(mesh.triangles.size() == mesh.corners.size() - 2 * mesh.polygon_count());
    for (const uint32_t v : mesh.corners) {
        REQUIRE(v < mesh.vertex_count());
    }
    for (const Vec3& p : mesh.positions) {
        REQUIRE(is_finite(p));
    }
    for (const Column& column : mesh.vertex_columns) {
        CHECK(column.values.size() == mesh.vertex_count());
    }
    for (const Column& column : mesh.polygon_columns) {
        CHECK(column.values.size() == mesh.polygon_count());
    }
    for (const CornerLayer* layer : {&mesh.texture_coordinates, &mesh.corner_normals}) {
        CHECK((layer->empty() || layer->index.size() == mesh.corners.size()));
        for (const uint32_t i : layer->index) {
            REQUIRE((i == no_index || (i + 1) * layer->components <= layer->values.size()));
        }
    }
}

struct Expectation {
    const char* file;
    const char* found; ///< a part of the error or warning: the cause
};

// What each damaged file has; tests/data/malformed/ok* load clean.
const std::vector<Expectation> errors = {
    {"all_degenerate.obj", "no face has area"},
    {"empty.off", "empty"},
    {"empty.ply", "empty"},
    {"empty.stl", "empty"},
    {"garbage.obj", "zero byte"},
    {"huge_list_count.ply", "byte 263: list 'vertex_indices' of 2147483647"},
    {"huge_vertex_count.ply", "line 3: the header announces 4000000000"},
    {"huge_vertex_count_ascii.ply", "line 3: the header announces 4000000000"},
    {"index_out_of_range.obj", "line 21: face refers to vertex 99 but the file has 8"},
    {"index_out_of_range.ply", "line 29: face refers to vertex 99 but there are 8"},
    {"index_overflow.obj", "line 21"},
    {"inf.obj", "line 7: x coordinate 1e400 is not a finite"},
    {"nan.obj", "line 8: x coordinate nan is not a finite"},
    {"nan_binary.ply", "of vertex"},
    {"negative_index_too_far.obj", "line 9: there is no vertex -60"},
    {"negative_list_count.ply", "byte 263: list 'vertex_indices' of -1"},
    {"no_end_header.ply", "end_header"},
    {"png_named.obj", "zero byte"},
    {"short_vertex_line.obj", "line 8: z coordinate is missing"},
    {"stl_ascii_truncated.stl", "ends inside a facet"},
    {"stl_binary_count_4e9.stl", "announces 4000000000 facets, but 12 follow"},
    {"stl_binary_count_too_big.stl", "announces 1000 facets, but 12 follow"},
    {"trunc.off", "line 12"},
    {"trunc_binary.ply", "byte 370"},
};
const std::vector<Expectation> warnings = {
    {"bowtie_vertex.obj", "1 bow-tie vertex (first: vertex 0)"},
    {"far_from_origin.obj", "far from the origin"},
    {"flipped_face.obj", "3 edges between faces of opposite orientation"},
    {"huge_coords.obj", "huge coordinates"},
    {"isolated_vertices.obj", "2 isolated vertices (first: vertex 0)"},
    {"nonplanar_quads.obj", "1 polygon far from planar"},
    {"stl_ascii_no_endsolid.stl", "endsolid"},
    {"stl_binary_count_too_small.stl", "announces 2 facets"},
    {"tiny_coords.obj", "tiny"},
    {"two_index_face.obj", "3 faces with fewer than three corners left out (first: line 21)"},
};

const fs::path malformed = fs::path(ANVIL_TEST_DATA) / "malformed";

} // namespace

TEST_CASE("Damaged files are errors that name file, place and cause", "[mesh][reader]") {
    for (const Expectation& expected : errors) {
        INFO(expected.file);
        Log log;
        try {
            read_mesh(malformed / expected.file, log);
            FAIL_CHECK("read without an error");
        } catch (const InputError& error) {
            CHECK_THAT(error.what(), Catch::Contains(expected.file));
            CHECK_THAT(error.what(), Catch::Contains(expected.found));
            CHECK_THAT(error.what(), Catch::Contains("; ")); // what would mend it
        }
    }
}

TEST_CASE("Odd files load with a warning that says what is odd", "[mesh][reader]") {
    for (const Expectation& expected : warnings) {
        INFO(expected.file);
        Log log;
        check_valid(read_mesh(malformed / expected.file, log));
        REQUIRE(log.warnings.size() == 1);
        CHECK_THAT(log.warnings[0], Catch::Contains(expected.found));
        CHECK_THAT(log.warnings[0], Catch::Contains(expected.file));
    }
}

TEST_CASE("Every legal variant of the cube loads clean: 8 vertices, 12 faces, closed", "[mesh][reader]") {
    size_t count = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(malformed)) {
        if (!entry.is_regular_file() || entry.path().string().find("malformed/ok") == std::string::npos) {
            continue;
        }
        INFO(entry.path());
        Log log;
        const Mesh mesh = read_mesh(entry.path(), log);
        check_valid(mesh);
        CHECK_THAT(log.warnings, Catch::Equals(std::vector<std::string>{}));
        CHECK(mesh.vertex_count() == 8);
        CHECK(mesh.polygon_count() == 12);
        CHECK(examine(mesh).volume.value_or(0) == Approx(1).epsilon(1e-15));
        ++count;
    }
    CHECK(count == 11);
}

TEST_CASE("Every malformed file has its expectation", "[mesh][reader]") {
    size_t files = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(malformed)) {
        files += entry.is_regular_file() ? 1 : 0;
    }
    CHECK(files == errors.size() + warnings.size() + 11);
}

TEST_CASE("Files cut off or changed at any byte give an error or a valid mesh", "[mesh][reader]") {
    const ScratchFolder folder;
    const std::vector<std::string> samples = {
        "ok_tabs_continuation_refs.obj", "ok_extra_props_vertex_index.ply", "ok_big_endian_double.ply",
        "ok_solid_prefixed_binary.stl",  "stl_ascii_no_endsolid.stl",       "ok_one_line_header.off"};
    for (const std::string& name : samples) {
        const std::string whole = content_of(malformed / name);
        for (size_t variant = 0; variant < 2 * whole.size(); ++variant) {
            INFO(name << " variant " << variant);
            std::string text = whole;
            if (variant < whole.size()) {
                text.resize(variant);
            } else {
                const size_t at = variant - whole.size();
                text[at] = static_cast<char>(text[at] ^ (1 << (at % 8)) ^ (at % 3 == 0 ? 0x80 : 0));
            }
            const fs::path path = folder / name;
            std::ofstream(path, std::ios::binary) << text;
            Log log;
            try {
                check_valid(read_mesh(path, log));
            } catch (const InputError& error) {
                CHECK_THAT(error.what(), Catch::Contains(name));
            }
        }
    }
}

TEST_CASE("What is no mesh file at all is an error that says so", "[mesh][reader]") {
    const ScratchFolder folder;
    Log log;
    fs::create_directory(folder / "x.obj");
    CHECK_THROWS_WITH(read_mesh(folder / "missing.obj", log),
                      Catch::Contains("missing.obj: cannot be opened"));
    CHECK_THROWS_WITH(read_mesh(folder / "x.obj", log), Catch::Contains("x.obj: is a directory"));
    CHECK_THROWS_WITH(read_mesh(folder / "x.fbx", log), Catch::Contains("unknown extension .fbx"));
    CHECK_THROWS_WITH(read_mesh(folder / "x", log), Catch::Contains("no extension"));
    std::ofstream(folder / "locked.obj") << cube_obj;
    fs::permissions(folder / "locked.obj", fs::perms::none);
    if (!std::ifstream(folder / "locked.obj").is_open()) { // the superuser may read it all the same
        CHECK_THROWS_WITH(read_mesh(folder / "locked.obj", log), Catch::Contains("allow reading it"));
    }
    CHECK_THAT(error_of("text.obj", "hello world\n"), Catch::Contains("no vertex"));
    CHECK_THAT(error_of("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), Catch::Contains("no face"));
    CHECK_THAT(error_of("lines.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n"), Catch::Contains("no face"));
    CHECK_THAT(error_of("zero.obj", std::string(cube_obj) + "f 0 1 2\n"), Catch::Contains("line 15"));
    CHECK_THAT(error_of("word.obj", std::string(cube_obj) + "f 1 2 x\n"), Catch::Contains("'x'"));
    CHECK_THAT(error_of("comma.obj", "v 0,5 0 0\n"), Catch::Contains("'0,5' is not a number"));
    CHECK_THAT(error_of("point.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n"),
               Catch::Contains("no face has area"));
    CHECK_THAT(error_of("large.obj", "v 1e37 0 0\n"), Catch::Contains("1e36"));
    CHECK_THAT(error_of("type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n"),
               Catch::Contains("line 4: unknown type 'quad'"));
    CHECK_THAT(
        error_of("noxyz.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nend_header\n1\n"),
        Catch::Contains("lack x, y or z"));
    CHECK_THAT(error_of("count.off", "OFF\n4000000000 1 0\n0 0 0\n"), Catch::Contains("line 2"));
    CHECK_THAT(error_of("negative.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"),
               Catch::Contains("line 6"));
    CHECK_THAT(error_of("escape.obj", "v \x1b[31m 0 0\n"), !Catch::Contains("\x1b"));
}

TEST_CASE("Damage of the same kinds elsewhere is found as well", "[mesh][reader]") {
    const auto ply = [](const std::string& vertex, const std::string& face) {
        return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
               "z\n"
               "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n" +
               vertex + "\n" + face + "\n";
    };
    CHECK(error_of("a.ply", ply("0 1 0", "3 0 1 2")) == "no error");
    CHECK_THAT(error_of("a.ply", ply("0 inf 0", "3 0 1 2")), Catch::Contains("line 12: y inf"));
    CHECK_THAT(error_of("a.ply", ply("0 1", "3 0 1 2")), Catch::Contains("line 12: number is missing"));
    CHECK_THAT(error_of("a.ply", ply("0 1 0", "3 0 1 -2")),
               Catch::Contains("line 13: '-2' is no vertex index"));
    CHECK_THAT(error_of("a.ply", ply("0 1 0", "3 0 1 4294967295")), Catch::Contains("line 13"));
    CHECK_THAT(error_of("a.ply", ply("0 1 0", "3 0 1")), Catch::Contains("line 13"));
    CHECK_THAT(error_of("a.ply", ply("0 1 0", "")), Catch::Contains("ends within its data"));
    CHECK_THAT(error_of("a.ply", ply("0 1 0", "2 0 1")), Catch::Contains("no face"));
    CHECK_THAT(error_of("a.ply", "ply\nelement vertex 0\nend_header\n"), Catch::Contains("no format"));
    CHECK_THAT(error_of("a.ply", "ply\nformat ascii 1.0\nelement vertex -5\nend_header\n"),
               Catch::Contains("line 3: element count -5 is negative"));
    CHECK_THAT(error_of("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 nan 0\n"),
               Catch::Contains("line 4: y coordinate nan"));
    CHECK_THAT(error_of("a.stl", "solid a\nendsolid a\n"), Catch::Contains("no vertex"));
    CHECK_THAT(error_of("a.stl", std::string(84, '\0')), Catch::Contains("no vertex"));
    CHECK_THAT(error_of("a.stl", std::string(83, 'x')), Catch::Contains("84 bytes"));
    std::string infinite = std::string(80, ' ') + std::string("\1\0\0\0", 4) + std::string(50, '\0');
    infinite.replace(84 + 12, 4, std::string("\0\0\x80\x7f", 4));
    CHECK_THAT(error_of("a.stl", infinite), Catch::Contains("byte 96"));
    CHECK_THAT(error_of("a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
               Catch::Contains("after 1 of 2 faces"));
    CHECK_THAT(error_of("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n999999 0 1 2\n"),
               Catch::Contains("line 6"));
    CHECK_THAT(error_of("a.off", "OFF BINARY\n"), Catch::Contains("binary OFF"));
    CHECK_THAT(error_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1/1 2 3\n"), Catch::Contains("line 4"));
    CHECK_THAT(error_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n"), Catch::Contains("line 4"));
}

TEST_CASE("A distant isolated vertex does not make the faces degenerate", "[mesh][reader]") {
    Log log;
    const Mesh mesh = read_text("a.obj", std::string(cube_obj) + "v 1e30 1e30 -1e30\n", log);
    const MeshHealth health = examine(mesh);
    CHECK(health.degenerate_triangles.count == 0);
    CHECK(health.volume.value_or(0) == Approx(1).epsilon(1e-15));
}

TEST_CASE("Wrong texture and normal references cost the attribute, not the shape", "[mesh][reader]") {
    Log log;
    const Mesh mesh =
        read_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn nan nan nan\nf 1/7/1 2//1 3//1\n", log);
    check_valid(mesh);
    CHECK(mesh.corner_normals.values == std::vector<double>{0, 0, 0});
    REQUIRE(log.warnings.size() == 1);
    CHECK_THAT(log.warnings[0], Catch::Contains("2 texture coordinates or normals"));
}

TEST_CASE("Numbers are read the same in a locale with a decimal comma", "[mesh][reader]") {
    const CommaLocale commas;
    Log log;
    const Mesh mesh = read_text("a.obj", "v 0.5 -1.25e1 +3\nv 1e-400 0 .5\nv 1 0. 0\nf 1 2 3\n", log);
    CHECK(mesh.positions == std::vector<Vec3>{{0.5, -12.5, 3}, {0, 0, 0.5}, {1, 0, 0}});
}

TEST_CASE("An OBJ file keeps texture coordinates, normals, colours and groups by corner", "[mesh][reader]") {
    Log log;
    const Mesh mesh =
        read_text("a.obj",
                  "mtllib a b.mtl\no thing\nv 0 0 0 1 0 0.5\nv 1 0 0 1 0 0.5\nv 1 1 0 1 0 0.5\n"
                  "v 0 1 0 1 0 0.5\nvt 0 0\nvt 0.25 1\nvn 0 0 1\ng left  part \nf 1/1/1 2/2/1 3//1\n"
                  "usemtl red\nf -4 3/2 4\n",
                  log);
    check_valid(mesh);
    CHECK(mesh.texture_coordinates.components == 2);
    CHECK(mesh.texture_coordinates.values == std::vector<double>{0, 0, 0.25, 1});
    CHECK(mesh.texture_coordinates.index == std::vector<uint32_t>{0, 1, no_index, no_index, 1, no_index});
    CHECK(mesh.corner_normals.index == std::vector<uint32_t>{0, 0, 0, no_index, no_index, no_index});
    REQUIRE(mesh.groups.size() == 3);
    CHECK(mesh.groups[1].text == "left  part");
    CHECK(mesh.groups[2].first_polygon == 1);
    CHECK(mesh.comments == std::vector<std::string>{"mtllib a b.mtl"});
    REQUIRE(mesh.vertex_columns.size() == 3);
    CHECK(mesh.vertex_columns[2].values == std::vector<double>(4, 0.5));
}

TEST_CASE("Equal STL positions are welded in the order of their first occurrence", "[mesh][reader]") {
    Log log;
    const Mesh mesh =
        read_text("a.stl",
                  "SOLID s\nfacet normal 0 0 1 outer loop\nvertex 1 0 0 vertex 0 0 0\nvertex 0 1 0\n"
                  "endloop endfacet\nfacet normal nan nan nan\nouter loop\nvertex -0 1 0\nvertex 0 0 1\n"
                  "vertex 1 0 0\nendloop\nendfacet\nendsolid s\n",
                  log);
    CHECK(mesh.positions == std::vector<Vec3>{{1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    CHECK(mesh.corners == std::vector<uint32_t>{0, 1, 2, 2, 3, 0});
    CHECK(log.warnings.empty());
}

TEST_CASE("OFF files with colours, normals and texture coordinates are read by their keyword",
          "[mesh][reader]") {
    Log log;
    const Mesh mesh =
        read_text("a.off",
                  "STCNOFF # all\n3 1 0\n0 0 0  0 0 1  255 0 7 9  0.5 1\n1 0 0  0 0 1  255 0 7 9  0.5 1\n"
                  "0 1 0  0 0 1  255 0 7 9  0.5 1\n3 0 1 2  0.5 0 1\n",
                  log);
    check_valid(mesh);
    REQUIRE(mesh.vertex_columns.size() == 9);
    CHECK(mesh.vertex_columns[2].values[1] == 1);
    CHECK(mesh.vertex_columns[3].type == ScalarType::uint8);
    CHECK(mesh.vertex_columns[6].values[2] == 9);
    CHECK(mesh.vertex_columns[7].values[0] == 0.5);
    REQUIRE(mesh.polygon_columns.size() == 3);
    CHECK(mesh.polygon_columns[0].type == ScalarType::float32);
    CHECK(mesh.polygon_columns[0].values[0] == 0.5);
}

TEST_CASE("Double precision is kept where float would lose more than 1e-8 of the diagonal",
          "[mesh][reader]") {
    Log log;
    CHECK_FALSE(read_text("a.obj", cube_obj, log).double_precision);
    CHECK(read_text("b.obj", "v 0.9 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", log).double_precision);
    CHECK(read_mesh(malformed / "ok_big_endian_double.ply", log).double_precision);
    CHECK(read_mesh(malformed / "far_from_origin.obj", log).double_precision);
}

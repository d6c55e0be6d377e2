#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/mesh/mesh_reader.h"
#include "engine/mesh/mesh_writer.h"

#include "tests/support/comma_locale.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

using namespace anvil;
namespace fs = std::filesystem;

namespace {

std::string content_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

void put(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

/// A prism of quads and two pentagons with every kind of attribute. Coordinates are exact in float.
Mesh rich_prism() {
    Mesh mesh;
    const std::vector<Vec3> base = {
        {1, 0, 0}, {0.25, 0.75, 0}, {-1, 0.5, 0}, {-1, -0.5, 0}, {0.25, -0.75, 0}};
    for (const double z : {0.0, 1.5}) {
        for (const Vec3& p : base) {
            mesh.positions.push_back(p + Vec3(0, 0, z));
        }
    }
    mesh.add_polygon(std::vector<uint32_t>{4, 3, 2, 1, 0});
    mesh.add_polygon(std::vector<uint32_t>{5, 6, 7, 8, 9});
    for (uint32_t i = 0; i < 5; ++i) {
        const uint32_t next = (i + 1) % 5;
        mesh.add_polygon(std::vector<uint32_t>{i, next, next + 5, i + 5});
    }
    triangulate(mesh);
    for (const auto& [name, step] :
         {std::pair("red", 25.0), std::pair("green", 11.0), std::pair("blue", 1.0)}) {
        Column column{name, ScalarType::uint8, {}};
        for (size_t v = 0; v < 10; ++v) {
            column.values.push_back(step * static_cast<double>(v));
        }
        mesh.vertex_columns.push_back(column);
    }
    mesh.vertex_columns.push_back({"quality", ScalarType::float64, std::vector<double>(10, 0.1)});
    mesh.polygon_columns.push_back({"label", ScalarType::int16, {-3, -2, -1, 0, 1, 2, 3000}});
    mesh.texture_coordinates.components = 2;
    mesh.corner_normals.components = 3;
    for (uint32_t f = 0; f < 7; ++f) {
        mesh.corner_normals.values.insert(mesh.corner_normals.values.end(), {0, f / 8.0, 1});
        for (size_t k = 0; k < mesh.polygon(f).size(); ++k) {
            // Each corner has its own texture coordinates: every edge is a seam.
            mesh.texture_coordinates.index.push_back(
                static_cast<uint32_t>(mesh.texture_coordinates.values.size() / 2));
            mesh.texture_coordinates.values.insert(mesh.texture_coordinates.values.end(),
                                                   {k / 4.0, f / 16.0});
            mesh.corner_normals.index.push_back(f);
        }
    }
    mesh.groups = {{0, "g", "caps"}, {0, "usemtl", "steel"}, {2, "g", "side faces"}};
    mesh.comments = {"mtllib prism.mtl"};
    return mesh;
}

Mesh read_quietly(const fs::path& path) {
    Log log;
    Mesh mesh = read_mesh(path, log);
    CHECK_THAT(log.warnings, Catch::Equals(std::vector<std::string>{}));
    return mesh;
}

std::vector<double> corner_values(const CornerLayer& layer) {
    std::vector<double> values;
    for (const uint32_t index : layer.index) {
        for (int i = 0; i < layer.components; ++i) {
            values.push_back(layer.values[index * layer.components + i]);
        }
    }
    return values;
}

/// Colours as fractions, whatever the type of their columns.
std::vector<double> colours_of(const Mesh& mesh) {
    std::vector<double> values;
    for (const Column& column : mesh.vertex_columns) {
        if (column.name == "red" || column.name == "green" || column.name == "blue") {
            for (const double value : column.values) {
                values.push_back(column.type == ScalarType::uint8 ? value / 255 : value);
            }
        }
    }
    return values;
}

const Column* find(const std::vector<Column>& columns, const std::string& name) {
    for (const Column& column : columns) {
        if (column.name == name) {
            return &column;
        }
    }
    return nullptr;
}

std::vector<Vec3> triangle_points(const Mesh& mesh) {
    std::vector<Vec3> points;
    for (const Triangle& t : mesh.triangles) {
        for (const uint32_t v : t) {
            points.push_back(mesh.positions[v]);
        }
    }
    return points;
}

const std::vector<std::string> formats = {"obj", "ply", "off", "stl"};

} // namespace

TEST_CASE("Between any two formats everything survives that both can hold", "[mesh][writer]") {
    const ScratchFolder folder;
    const Mesh original = rich_prism();
    for (const std::string& first : formats) {
        for (const std::string& second : formats) {
            INFO(first << " to " << second);
            write_mesh(folder / ("a." + first), original, original.positions);
            const Mesh between = read_quietly(folder / ("a." + first));
            write_mesh(folder / ("b." + second), between, between.positions);
            const Mesh mesh = read_quietly(folder / ("b." + second));
            CHECK(triangle_points(mesh) == triangle_points(original));
            const auto both = [&](const std::string& able) {
                return able.find(first) != std::string::npos && able.find(second) != std::string::npos;
            };
            if (both("obj ply off")) {
                CHECK(mesh.positions == original.positions);
                CHECK(mesh.corners == original.corners);
                CHECK(mesh.polygon_begin == original.polygon_begin);
                const std::vector<double> wanted = colours_of(original);
                const std::vector<double> colours = colours_of(mesh);
                REQUIRE(colours.size() == wanted.size());
                for (size_t i = 0; i < wanted.size(); ++i) {
                    // half an ulp of float below 1
                    CHECK(colours[i] == Approx(wanted[i]).margin(0x1p-25));
                }
            }
            if (both("obj ply")) {
                CHECK(corner_values(mesh.texture_coordinates) == corner_values(original.texture_coordinates));
            }
            if (both("obj")) {
                CHECK(corner_values(mesh.corner_normals) == corner_values(original.corner_normals));
                REQUIRE(mesh.groups.size() == 3);
                CHECK(mesh.groups[2].first_polygon == 2);
                CHECK(mesh.groups[2].text == "side faces");
                CHECK(mesh.comments == original.comments);
            }
            if (both("ply")) {
                REQUIRE(find(mesh.vertex_columns, "quality") != nullptr);
                CHECK(find(mesh.vertex_columns, "quality")->type == ScalarType::float64);
                CHECK(find(mesh.vertex_columns, "quality")->values == original.vertex_columns[3].values);
                CHECK(find(mesh.vertex_columns, "red")->type == ScalarType::uint8);
                REQUIRE(find(mesh.polygon_columns, "label") != nullptr);
                CHECK(find(mesh.polygon_columns, "label")->type == ScalarType::int16);
                CHECK(find(mesh.polygon_columns, "label")->values == original.polygon_columns[0].values);
            }
        }
    }
}

TEST_CASE("A file that was read and not changed is written byte for byte the same again", "[mesh][writer]") {
    const ScratchFolder folder;
    Mesh original = rich_prism();
    for (const std::string& format : formats) {
        INFO(format);
        original.comments.clear(); // readers of OFF ignore them
        write_mesh(folder / ("a." + format), original, original.positions);
        const Mesh mesh = read_quietly(folder / ("a." + format));
        write_mesh(folder / ("b." + format), mesh, mesh.positions);
        CHECK(content_of(folder / ("a." + format)) == content_of(folder / ("b." + format)));
    }
}

TEST_CASE("STL attribute words and OFF normals, colours and texture coordinates survive", "[mesh][writer]") {
    const ScratchFolder folder;
    Mesh mesh = rich_prism();
    mesh.polygon_columns = {{"attribute", ScalarType::uint16, {1, 2, 3, 4, 5, 6, 65535}}};
    write_mesh(folder / "a.stl", mesh, mesh.positions);
    const Mesh stl = read_quietly(folder / "a.stl");
    REQUIRE(find(stl.polygon_columns, "attribute") != nullptr);
    CHECK(find(stl.polygon_columns, "attribute")->values.front() == 1);
    CHECK(find(stl.polygon_columns, "attribute")->values.back() == 65535);

    const std::string off =
        "STCNOFF\n3 1 0\n0 0 0 0 0 1 0.5 1.0 0.0 1.0 0.5 1\n1 0 0 0 0 1 0.5 1.0 0.0 1.0 0.5 1\n"
        "0 1 0 0 0 1 0.5 1.0 0.0 1.0 0.5 1\n3 0 1 2 255 0 7\n";
    put(folder / "a.off", off);
    const Mesh read = read_quietly(folder / "a.off");
    write_mesh(folder / "b.off", read, read.positions);
    CHECK(content_of(folder / "b.off") == off);
    // The same per vertex, but as OBJ has it.
    write_mesh(folder / "c.obj", read, read.positions);
    const Mesh obj = read_quietly(folder / "c.obj");
    CHECK(corner_values(obj.texture_coordinates) == std::vector<double>{0.5, 1, 0.5, 1, 0.5, 1});
    CHECK(corner_values(obj.corner_normals) == std::vector<double>{0, 0, 1, 0, 0, 1, 0, 0, 1});
    // And back: every vertex has one value, so that columns can hold it.
    write_mesh(folder / "d.off", obj, obj.positions);
    CHECK(content_of(folder / "d.off").substr(0, 7) == "STCNOFF");
}

TEST_CASE("Vertices that did not move are written exactly, decimals included", "[mesh][writer]") {
    const ScratchFolder folder;
    const std::string text = "v 0.1 1e-30 123456.789\nv 0.30000000000000004 0 0\nv 1 0 0\nf 1 2 3\n";
    put(folder / "a.obj", text);
    const Mesh mesh = read_quietly(folder / "a.obj");
    std::vector<Vec3> positions = mesh.positions;
    positions[2].y = 1.0 / 3;
    write_mesh(folder / "b.obj", mesh, positions, OutputPrecision::single_precision);
    CHECK(content_of(folder / "b.obj") ==
          "v 0.1 1e-30 123456.789\nv 0.30000000000000004 0 0\nv 1 0.33333334 0\nf 1 2 3\n");
    write_mesh(folder / "b.obj", mesh, positions, OutputPrecision::double_precision);
    CHECK(content_of(folder / "b.obj") ==
          "v 0.1 1e-30 123456.789\nv 0.30000000000000004 0 0\nv 1 0.3333333333333333 0\nf 1 2 3\n");
}

TEST_CASE("PLY is float where float is exact enough and double elsewhere", "[mesh][writer]") {
    const ScratchFolder folder;
    const Mesh mesh = rich_prism();
    const auto type_written = [&](const Mesh& m, const std::vector<Vec3>& positions,
                                  OutputPrecision precision) {
        write_mesh(folder / "a.ply", m, positions, precision);
        return content_of(folder / "a.ply").find("property double x") != std::string::npos ? "double"
                                                                                           : "float";
    };
    std::vector<Vec3> positions = mesh.positions;
    CHECK(type_written(mesh, positions, OutputPrecision::automatic) == std::string("float"));
    CHECK(type_written(mesh, positions, OutputPrecision::double_precision) == std::string("double"));
    positions[3].x += 1e-9; // lost in float, but below 1e-8 of the diagonal (2.9)
    CHECK(type_written(mesh, positions, OutputPrecision::automatic) == std::string("float"));
    for (Vec3& p : positions) {
        p += Vec3(1e5 + 0.01);
    }
    CHECK(type_written(mesh, positions, OutputPrecision::automatic) == std::string("double"));
    CHECK(type_written(mesh, positions, OutputPrecision::single_precision) == std::string("float"));
    Mesh precise = mesh;
    precise.double_precision = true;
    CHECK(type_written(precise, mesh.positions, OutputPrecision::automatic) == std::string("double"));
}

TEST_CASE("Polygons of hundreds of corners survive PLY with their texture coordinates", "[mesh][writer]") {
    const ScratchFolder folder;
    Mesh mesh;
    std::vector<uint32_t> corners;
    mesh.texture_coordinates.components = 2;
    for (uint32_t i = 0; i < 300; ++i) {
        const double angle = i * 6.283185307179586 / 300;
        mesh.positions.push_back(
            Vec3(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0));
        corners.push_back(i);
        mesh.texture_coordinates.index.push_back(i);
        mesh.texture_coordinates.values.insert(mesh.texture_coordinates.values.end(), {i / 512.0, 0});
    }
    mesh.add_polygon(corners);
    triangulate(mesh);
    write_mesh(folder / "a.ply", mesh, mesh.positions);
    const Mesh read = read_quietly(folder / "a.ply");
    CHECK(read.corners == corners);
    CHECK(read.texture_coordinates.values == mesh.texture_coordinates.values);
}

TEST_CASE("Numbers are written the same in a locale with a decimal comma", "[mesh][writer]") {
    const ScratchFolder folder;
    Mesh mesh = rich_prism();
    mesh.positions[0].x = 12345.5;
    for (const std::string& format : formats) {
        write_mesh(folder / ("a." + format), mesh, mesh.positions);
    }
    const CommaLocale commas;
    for (const std::string& format : formats) {
        write_mesh(folder / ("b." + format), mesh, mesh.positions);
    }
    for (const std::string& format : formats) {
        CHECK(content_of(folder / ("a." + format)) == content_of(folder / ("b." + format)));
    }
}

TEST_CASE("A file is written whole or not at all, and nothing else is left beside it", "[mesh][writer]") {
    const ScratchFolder folder;
    const Mesh mesh = rich_prism();
    const auto entries = [&] {
        return std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator());
    };
    CHECK_THROWS_WITH(write_mesh(folder / "no/such/a.ply", mesh, mesh.positions),
                      Catch::Contains("no/such/a.ply"));
    CHECK_THROWS_AS(write_mesh(folder / "no/such/a.ply", mesh, mesh.positions), WriteError);
    CHECK_THROWS_AS(write_mesh(folder / "a.xyz", mesh, mesh.positions), InputError);
    fs::create_directory(folder / "folder.ply");
    CHECK_THROWS_AS(write_mesh(folder / "folder.ply", mesh, mesh.positions), WriteError);
    CHECK_THROWS_AS(write_file_atomically("/dev/full", std::string_view("text")), WriteError);
    CHECK(entries() == 1);
    write_mesh(folder / (std::string(240, 'n') + ".ply"), mesh, mesh.positions);
    put(folder / "old.off", "old");
    fs::create_symlink("old.off", folder / "link.off");
    write_mesh(folder / "link.off", mesh, mesh.positions);
    CHECK(fs::is_symlink(folder / "link.off"));
    CHECK(content_of(folder / "old.off").find("OFF\n") != std::string::npos);
    CHECK(entries() == 4);
}

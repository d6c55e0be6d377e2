#include "engine/mesh/health.h"
#include "engine/mesh/mesh_reader.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <numbers>

using namespace anvil;

namespace {

using Polygons = std::vector<std::vector<uint32_t>>;

Mesh build(std::vector<Vec3> positions, const Polygons& polygons) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    for (const std::vector<uint32_t>& polygon : polygons) {
        mesh.add_polygon(polygon);
    }
    triangulate(mesh);
    return mesh;
}

const std::vector<Vec3> cube_corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                        {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
const Polygons cube_faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

} // namespace

TEST_CASE("A cube of quads is closed, has volume 1, area 6 and angles of 45 degrees at any scale",
          "[mesh][health]") {
    for (const double scale : {1.0, 1e-30, 1e30}) {
        std::vector<Vec3> corners = cube_corners;
        for (Vec3& p : corners) {
            p *= scale;
        }
        const MeshHealth health = examine(build(corners, cube_faces));
        CHECK(health.vertices == 8);
        CHECK(health.polygons == 6);
        CHECK(health.triangles == 12);
        CHECK(health.edges == 12);
        CHECK(health.components == 1);
        CHECK(health.euler_number == 2);
        CHECK(health.closed);
        CHECK(health.boundary_edges == 0);
        CHECK(health.boundary_loops == 0);
        CHECK(health.degenerate_triangles.count == 0);
        CHECK(health.nonplanar_polygons.count == 0);
        CHECK(health.volume.value_or(0) == Approx(scale * scale * scale).epsilon(1e-14));
        CHECK(health.area == Approx(6 * scale * scale).epsilon(1e-14));
        CHECK(health.min_angle == Approx(45).epsilon(1e-14));
        CHECK(health.diagonal == Approx(std::sqrt(3.0) * scale).epsilon(1e-14));
    }
}

TEST_CASE("Holes are counted as loops, those that touch in a vertex as one", "[mesh][health]") {
    // Without top and bottom: two loops. Without two adjacent sides: one loop of six edges.
    const MeshHealth tube =
        examine(build(cube_corners, {cube_faces[2], cube_faces[3], cube_faces[4], cube_faces[5]}));
    CHECK(tube.boundary_loops == 2);
    CHECK(tube.boundary_edges == 8);
    CHECK(tube.euler_number == 0);
    CHECK_FALSE(tube.closed);
    CHECK_FALSE(tube.volume);
    const MeshHealth cup =
        examine(build(cube_corners, {cube_faces[0], cube_faces[1], cube_faces[2], cube_faces[4]}));
    CHECK(cup.boundary_loops == 1);
    CHECK(cup.boundary_edges == 6);
    // Two triangles joined at one vertex: their borders touch.
    const MeshHealth bowtie =
        examine(build({{0, 0, 0}, {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}));
    CHECK(bowtie.bowtie_vertices.count == 1);
    CHECK(bowtie.bowtie_vertices.first == 0);
    CHECK(bowtie.boundary_loops == 1);
    CHECK(bowtie.components == 1);
}

TEST_CASE("Edges of three faces, flipped faces, isolated, repeated and degenerate parts are found",
          "[mesh][health]") {
    const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0},
                                      {0, 0, 1}, {9, 9, 9}, {1, 0, 0}, {2, 0, 0}};
    const MeshHealth health = examine(build(points, {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}, {0, 6, 7}, {6, 6, 2}}));
    CHECK(health.non_manifold_edges.count == 1);
    CHECK(health.non_manifold_edges.first == 0);
    CHECK(health.isolated_vertices.count == 1);
    CHECK(health.isolated_vertices.first == 5);
    CHECK(health.duplicate_positions.count == 1);
    CHECK(health.duplicate_positions.first == 6);
    CHECK(health.degenerate_triangles.count == 2);
    CHECK(health.degenerate_triangles.first == 3);
    CHECK(health.min_angle == Approx(45).epsilon(1e-14));

    Polygons flipped = cube_faces;
    std::swap(flipped[5][1], flipped[5][3]);
    const MeshHealth cube = examine(build(cube_corners, flipped));
    CHECK(cube.inconsistent_edges.count == 4);
    CHECK_FALSE(cube.closed);
}

TEST_CASE("Planarity and needles are judged by shape, not size", "[mesh][health]") {
    for (const double scale : {1e-20, 1.0, 1e20}) {
        const double thin = 2 * std::tan(std::numbers::pi / 180);
        const auto at = [scale](double x, double y, double z) { return scale * Vec3(x, y, z); };
        const MeshHealth needle = examine(build({at(0, 0, 0), at(2, 0, 0), at(2, thin, 0)}, {{0, 1, 2}}));
        CHECK(needle.needles == 1);
        CHECK(needle.min_angle == Approx(1).epsilon(1e-12));
        const MeshHealth bent =
            examine(build({at(0, 0, 0), at(1, 0, .01), at(1, 1, 0), at(0, 1, .01)}, {{0, 1, 2, 3}}));
        CHECK(bent.nonplanar_polygons.count == 1);
        CHECK(bent.folded_polygons.count == 0);
    }
}

TEST_CASE("Known meshes have their published counts", "[mesh][health]") {
    const char* folder = std::getenv("ANVIL_TEST_MESHES");
    if (folder == nullptr) {
        WARN("skipped: ANVIL_TEST_MESHES names no folder");
        return;
    }
    struct Row {
        const char* file;
        size_t vertices, polygons, components, loops, bowties, duplicates;
        double min_angle;
        size_t needles;
        double diagonal;
        long long euler;
    };
    const std::vector<Row> table = {
        {"armadillo.ply", 14587, 29170, 1, 0, 0, 0, 19.14, 0, 1.505, 2},
        {"bunny.obj", 3301, 6598, 1, 0, 0, 0, 20.71, 0, 2.49, 2},
        {"fandisk.obj", 6475, 12946, 1, 0, 0, 0, 17.05, 0, 7.616, 2},
        {"fandisk.stl", 6475, 12946, 1, 0, 0, 0, 17.05, 0, 7.616, 2},
        {"hand_closed.obj", 7993, 15982, 1, 0, 0, 0, 20.37, 0, 1.215, 2},
        {"hand_closed_loop3.ply", 511426, 1022848, 1, 0, 0, 0, 21.37, 0, 1.213, 2},
        {"hand_lowres_open.obj", 810, 1602, 1, 1, 0, 0, 13.94, 0, 1.222, 1},
        {"human_woman.obj", 6890, 13776, 1, 0, 0, 0, 2.24, 5, 2.371, 2},
        {"makehuman_body.obj", 13380, 13378, 1, 0, 0, 0, 3.06, 14, 19.85, 2},
        {"makehuman_body_loop2.ply", 214050, 428096, 1, 0, 0, 0, 3.92, 30, 19.82, 2},
        {"nefertiti.obj", 49971, 99938, 1, 0, 0, 0, 0.06, 255, 658.1, 2},
        {"sphere.obj", 642, 1280, 1, 0, 0, 0, 54.07, 0, 3.464, 2},
        {"spot_control_mesh.obj", 188, 180, 1, 0, 0, 0, 0.17, 20, 2.749, 2},
        {"suzanne.obj", 507, 500, 3, 4, 0, 2, 7.16, 0, 3.775, 2},
        {"teapot.obj", 3644, 6320, 4, 10, 38, 403, 3.35, 256, 8.205, -34},
        {"torus.off", 2304, 4608, 1, 0, 0, 0, 36.85, 0, 3.571, 0},
    };
    for (const Row& row : table) {
        INFO(row.file);
        Log log;
        const MeshHealth health = examine(read_mesh(std::filesystem::path(folder) / row.file, log));
        for (const std::string& warning : log.warnings) {
            UNSCOPED_INFO(warning);
        }
        CHECK(health.vertices == row.vertices);
        CHECK(health.polygons == row.polygons);
        CHECK(health.components == row.components);
        CHECK(health.boundary_loops == row.loops);
        CHECK(health.bowtie_vertices.count == row.bowties);
        CHECK(health.duplicate_positions.count == row.duplicates);
        if (health.triangles == health.polygons) { // else the angles depend on how polygons are split
            CHECK(health.min_angle == Approx(row.min_angle).margin(0.005));
            CHECK(health.needles == row.needles);
        }
        CHECK(health.diagonal == Approx(row.diagonal).epsilon(5e-4));
        CHECK(health.euler_number == row.euler);
        CHECK(health.non_manifold_edges.count == 0);
        CHECK(health.inconsistent_edges.count == 0);
        CHECK(health.degenerate_triangles.count == 0);
        CHECK(health.isolated_vertices.count == 0);
    }
}

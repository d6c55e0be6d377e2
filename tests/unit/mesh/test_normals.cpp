#include "engine/mesh/normals.h"

#include <catch2/catch.hpp>

#include <numbers>

using namespace anvil;

namespace {

/// Strip of quads in the plane z = 0: vertex 2 i at (i, 0, 0) and 2 i + 1 at (i, 1, 0).
Mesh strip(uint32_t quads) {
    Mesh mesh;
    for (uint32_t i = 0; i <= quads; ++i) {
        mesh.positions.emplace_back(i, 0, 0);
        mesh.positions.emplace_back(i, 1, 0);
    }
    for (uint32_t i = 0; i < quads; ++i) {
        mesh.add_polygon(std::vector<uint32_t>{2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
    }
    triangulate(mesh);
    return mesh;
}

Vec3 corner_normal(const Mesh& mesh, size_t corner) {
    const double* value = mesh.corner_normals.values.data() + 3 * size_t{mesh.corner_normals.index[corner]};
    return {value[0], value[1], value[2]};
}

} // namespace

TEST_CASE("A rigid rotation turns file normals with the surface, whatever they are", "[mesh][normals]") {
    Mesh mesh = strip(4);
    // Not the geometric normals: a slanted one in the columns, a flat and a creased one at the corners. In
    // the plane of rotation the shortest rotation of the vertex normal is the rotation itself.
    const size_t n = mesh.vertex_count();
    mesh.vertex_columns = {{"nx", ScalarType::float32, std::vector<double>(n, 0.6)},
                           {"ny", ScalarType::float32, std::vector<double>(n, 0)},
                           {"nz", ScalarType::float32, std::vector<double>(n, 0.8)}};
    mesh.corner_normals.components = 3;
    mesh.corner_normals.values = {0, 0, 1, -0.6, 0, 0.8};
    for (size_t c = 0; c < mesh.corners.size(); ++c) {
        mesh.corner_normals.index.push_back(c % 2);
    }
    for (const double degrees : {30.0, 120.0, 180.0}) {
        Mesh turned = mesh;
        const double angle = degrees * std::numbers::pi / 180;
        const auto rotate = [angle](const Vec3& p) {
            return Vec3(std::cos(angle) * p.x + std::sin(angle) * p.z, p.y,
                        std::cos(angle) * p.z - std::sin(angle) * p.x);
        };
        std::vector<Vec3> positions;
        for (const Vec3& p : mesh.positions) {
            positions.push_back(rotate(p));
        }
        update_normals(turned, positions, std::vector<bool>(n, true));
        // 180 degrees leave the axis open: only the geometric normal is then determined.
        const bool determined = degrees < 180;
        for (size_t v = 0; v < n && determined; ++v) {
            const Vec3 found(turned.vertex_columns[0].values[v], turned.vertex_columns[1].values[v],
                             turned.vertex_columns[2].values[v]);
            CHECK(glm::length(found - rotate({0.6, 0, 0.8})) < 1e-14);
        }
        for (size_t c = 0; c < mesh.corners.size(); ++c) {
            if (determined || c % 2 == 0) {
                CHECK(glm::length(corner_normal(turned, c) - rotate(corner_normal(mesh, c))) < 1e-14);
            }
        }
    }
}

TEST_CASE("Normals change at moved vertices and their neighbours only", "[mesh][normals]") {
    Mesh mesh = strip(6);
    const size_t n = mesh.vertex_count();
    mesh.vertex_columns = {{"nx", ScalarType::float32, std::vector<double>(n, 0.1)},
                           {"ny", ScalarType::float32, std::vector<double>(n, 0.2)},
                           {"nz", ScalarType::float32, std::vector<double>(n, 0.3)}};
    mesh.corner_normals.components = 3;
    mesh.corner_normals.values = {0.1, 0.2, 0.9};
    mesh.corner_normals.index.assign(mesh.corners.size(), 0); // one entry for all
    const Mesh before = mesh;
    std::vector<Vec3> positions = mesh.positions;
    std::vector<bool> moved(n, false);
    positions[0].z += 0.5;
    positions[1].z += 0.5;
    moved[0] = moved[1] = true;
    update_normals(mesh, positions, moved);
    for (size_t v = 0; v < n; ++v) {
        const bool same = mesh.vertex_columns[0].values[v] == before.vertex_columns[0].values[v];
        CHECK(same == (v >= 4));
    }
    for (size_t c = 0; c < mesh.corners.size(); ++c) {
        CHECK((corner_normal(mesh, c) == corner_normal(before, c)) == (mesh.corners[c] >= 4));
        CHECK(glm::length(corner_normal(mesh, c)) == Approx(glm::length(Vec3(0.1, 0.2, 0.9))).epsilon(1e-15));
    }
    // One entry is kept for the unmoved corners, one is added for each of the four vertices.
    CHECK(mesh.corner_normals.values.size() == 3 * 5);
    CHECK(mesh.positions == before.positions);
}

TEST_CASE("Without movement no normal changes a bit", "[mesh][normals]") {
    Mesh mesh = strip(2);
    mesh.corner_normals.components = 3;
    mesh.corner_normals.values = {0.1, 0.2, 0.9};
    mesh.corner_normals.index.assign(mesh.corners.size(), 0);
    const Mesh before = mesh;
    update_normals(mesh, mesh.positions, std::vector<bool>(mesh.vertex_count(), true));
    CHECK(mesh.corner_normals.values == before.corner_normals.values);
    CHECK(mesh.corner_normals.index == before.corner_normals.index);
}

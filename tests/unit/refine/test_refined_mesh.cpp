#include "engine/mesh/sample_shapes.h"
#include "engine/refine/point_vertices.h"
#include "engine/refine/refined_places.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/refine_checks.h"

#include <catch2/catch.hpp>
#include <random>

using namespace anvil;
using namespace anvil::test;

namespace {

/// Two squares (0 1 4 3) and (1 2 5 4) and a pentagon above the second; texture with a seam along edge 1-4.
Mesh seamed_strip() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0},     {0, 1, 0}, {1, 1, 0},
                      {2, 1, 0}, {2, 2, 0}, {1.5, 2.5, 0}, {1, 2, 0}};
    mesh.add_polygon(std::array<uint32_t, 4>{0, 1, 4, 3});
    mesh.add_polygon(std::array<uint32_t, 4>{1, 2, 5, 4});
    mesh.add_polygon(std::array<uint32_t, 5>{4, 5, 6, 7, 8});
    triangulate(mesh);
    mesh.texture_coordinates = {
        2,
        {0, 0, 0.5, 0, 0.5, 1, 0, 1, /* right of the seam */ 10, 10, 11, 10, 11, 11, 10, 11},
        {0, 1, 2, 3, 4, 5, 6, 7, no_index, no_index, no_index, no_index, no_index}};
    mesh.vertex_columns = {{"red", ScalarType::uint8, {0, 100, 200, 0, 101, 200, 255, 255, 255}},
                           {"heat", ScalarType::float32, {0, 1, 2, 3, 4, 5, 6, 7, 8}},
                           {"nx", ScalarType::float32, {1, 0, 0, 0, 1, 0, 0, 0, 0}},
                           {"ny", ScalarType::float32, {0, 1, 1, 1, 0, 1, 1, 1, 1}},
                           {"nz", ScalarType::float32, {0, 0, 0, 0, 0, 0, 0, 0, 0}}};
    mesh.polygon_columns = {{"material", ScalarType::int32, {5, 6, 7}}};
    mesh.groups = {{0, "g", "left"}, {1, "g", "right"}, {2, "g", "top"}};
    return mesh;
}

SurfacePoint middle_of_edge(const Mesh& mesh, uint32_t a, uint32_t b, double place) {
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        Vec3 weights(0);
        int found = 0;
        for (int i = 0; i < 3; ++i) {
            if (mesh.triangles[t][i] == a || mesh.triangles[t][i] == b) {
                weights[i] = mesh.triangles[t][i] == a ? 1 - place : place;
                ++found;
            }
        }
        if (found == 2) {
            return {t, weights};
        }
    }
    return {};
}

Vec3 texture_at(const Mesh& mesh, size_t corner) {
    const uint32_t entry = mesh.texture_coordinates.index[corner];
    return {mesh.texture_coordinates.values[2 * entry], mesh.texture_coordinates.values[2 * entry + 1], 0};
}

} // namespace

TEST_CASE("Attributes of new vertices lie between those of their parents, on each side of a seam") {
    const Mesh mesh = seamed_strip();
    const SurfacePoint point = middle_of_edge(mesh, 1, 4, 0.25);
    const PointVertices made = make_vertices(mesh, {&point, 1});
    const Mesh& out = made.refined.mesh;
    REQUIRE(out.vertex_count() == 10);
    REQUIRE(made.vertices == std::vector<uint32_t>{9});
    CHECK(out.positions[9] == Vec3(1, 0.25, 0));
    CHECK(out.vertex_columns[0].values[9] == 100); // a whole number
    CHECK(out.vertex_columns[1].values[9] == 1.75);
    const Vec3 normal(out.vertex_columns[2].values[9], out.vertex_columns[3].values[9],
                      out.vertex_columns[4].values[9]);
    CHECK(glm::length(normal) == Approx(1));
    CHECK(normal.y == Approx(3 * normal.x));
    // Both squares were divided, each into its two triangles and the one cut in two; the pentagon was not.
    REQUIRE(out.polygon_count() == 7);
    CHECK(out.polygon(6).size() == 5);
    CHECK(out.polygon_columns[0].values == std::vector<double>{5, 5, 5, 6, 6, 6, 7});
    REQUIRE(out.groups.size() == 3);
    CHECK(out.groups[1].first_polygon == 3);
    CHECK(out.groups[2].first_polygon == 6);
    REQUIRE(out.texture_coordinates.index.size() == out.corners.size());
    int left = 0;
    int right = 0;
    for (size_t c = 0; c < out.corners.size(); ++c) {
        if (out.corners[c] == 9) {
            const bool is_left = c < out.polygon_begin[3];
            (is_left ? left : right) += 1;
            CHECK(texture_at(out, c) == (is_left ? Vec3(0.5, 0.25, 0) : Vec3(10, 10.25, 0)));
        }
    }
    CHECK(left == 2);
    CHECK(right == 2);
    // One entry a side, not one a corner.
    CHECK(out.texture_coordinates.values.size() == mesh.texture_coordinates.values.size() + 4);
}

TEST_CASE("Any points become vertices where they are") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> weight(0, 1);
    const Mesh mesh = make_sample("icosphere", 42);
    for (int trial = 0; trial < 30; ++trial) {
        std::vector<SurfacePoint> points;
        for (int i = 0; i < 6; ++i) {
            // Few triangles, so that points meet in one.
            const auto t = static_cast<uint32_t>(random() % 3);
            Vec3 b(weight(random), weight(random), weight(random));
            b[trial % 3] = i % 3 == 1 ? 0 : b[trial % 3];
            points.push_back({t, b / (b.x + b.y + b.z)});
        }
        points.push_back(vertex_point(mesh, 5));
        points.push_back(points[0]);
        const PointVertices made = make_vertices(mesh, points);
        for (size_t i = 0; i < points.size(); ++i) {
            const Vec3 wanted = position(mesh, mesh.positions, points[i]);
            // Places are snapped by 1e-9 of a face a few times.
            CHECK(glm::distance(made.refined.mesh.positions[made.vertices[i]], wanted) < 1e-8);
        }
        CHECK(made.vertices.back() == made.vertices[0]);
        CHECK(made.vertices[6] == 5);
        CHECK(facts_of(made.refined.mesh).closed_manifold());
        CHECK(count_flipped(mesh, made.refined) == 0);
        CHECK(area_of(made.refined.mesh) == Approx(area_of(mesh)).epsilon(1e-12));
    }
}

TEST_CASE("Addresses keep their places through several refinements") {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> weight(0, 1);
    const Mesh mesh = make_sample("icosphere", 42);
    RefinementHistory history(mesh);
    Mesh current = mesh;
    for (int round = 0; round < 3; ++round) {
        HandleField handle = field_from(current, {static_cast<uint32_t>(random() % 42)}, "plateau", 0.8);
        Progress progress;
        const auto criterion = make_shape_criterion();
        const Refinement result =
            refine(current.triangles, state_of(current, {handle}), *criterion, {0.05, 0, 100000}, progress);
        const RefinedMesh refined = divided(current, result.state.parents, result.faces);
        REQUIRE(!refined.parents.empty());
        history.add(refined);
        current = refined.mesh;
        for (int trial = 0; trial < 50; ++trial) {
            const auto t = static_cast<uint32_t>(random() % mesh.triangles.size());
            Vec3 b(weight(random), weight(random), weight(random));
            b /= b.x + b.y + b.z;
            const SurfacePoint found = history.find(current.triangles, t, b);
            CHECK(glm::distance(position(current, current.positions, found),
                                position(mesh, mesh.positions, {t, b})) < 1e-8);
            // And back: to the same place, in that triangle or, on an edge, in its neighbour.
            CHECK(glm::distance(position(mesh, mesh.positions, history.find_first(current.triangles, found)),
                                position(mesh, mesh.positions, {t, b})) < 1e-8);
        }
    }
}

TEST_CASE("Edges with three faces are split in all of them") {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 0, 1}};
    for (const uint32_t apex : {2U, 3U, 4U}) {
        mesh.add_polygon(std::array<uint32_t, 3>{0, 1, apex});
    }
    triangulate(mesh);
    const SurfacePoint point{1, {0.5, 0.5, 0}};
    const PointVertices made = make_vertices(mesh, {&point, 1});
    CHECK(made.refined.mesh.triangles.size() == 6);
    CHECK(area_of(made.refined.mesh) == Approx(area_of(mesh)).epsilon(1e-15));
    for (const Triangle& t : made.refined.mesh.triangles) {
        CHECK((t[0] == 5 || t[1] == 5 || t[2] == 5));
    }
}

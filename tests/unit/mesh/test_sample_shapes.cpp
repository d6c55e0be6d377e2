#include "engine/core/error.h"
#include "engine/mesh/sample_shapes.h"
#include "tests/support/mesh_checks.h"

#include <catch2/catch.hpp>

using namespace anvil;

namespace {

constexpr double pi = 3.14159265358979323846;

bool within_a_tenth(size_t count, size_t wish) {
    return std::abs(static_cast<double>(count) - static_cast<double>(wish)) <=
           0.1 * static_cast<double>(wish);
}

size_t least_count(const std::string& shape) {
    return shape == "torus" ? 9 : shape == "cube" || shape == "cylinder" ? 8 : 4;
}

/// Distance from the surface that the shape's vertices must lie on.
double off_surface(const std::string& shape, const Vec3& p) {
    const double from_axis = std::hypot(p.x, p.z);
    if (shape == "plane") {
        return std::max(std::abs(p.z), std::max(std::abs(p.x), std::abs(p.y)) - 0.5);
    }
    if (shape == "cube") {
        return std::abs(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) - 0.5);
    }
    if (shape == "cylinder") {
        return std::abs(std::max(from_axis - 0.5, std::abs(p.y) - 1));
    }
    if (shape == "torus") {
        return std::abs(std::hypot(from_axis - 1, p.y) - 0.4);
    }
    return std::abs(glm::length(p) - 1);
}

} // namespace

TEST_CASE("Every sample of closed form keeps its count within 10 % and is closed, manifold and outward") {
    for (const std::string shape : {"sphere", "icosphere", "cube", "cylinder", "torus", "plane"}) {
        std::vector<size_t> wishes{997, 1000, 2500, 10000, 12345};
        for (size_t n = least_count(shape); n < 130; ++n) {
            wishes.push_back(n);
        }
        for (const size_t wish : wishes) {
            const Mesh mesh = make_sample(shape, wish);
            const test::MeshFacts facts = test::facts_of(mesh);
            CAPTURE(shape, wish, mesh.vertex_count());
            CHECK(within_a_tenth(mesh.vertex_count(), wish));
            CHECK(facts.components == 1);
            CHECK(facts.non_manifold_edges + facts.bow_tie_vertices + facts.isolated_vertices == 0);
            CHECK(facts.degenerate_triangles == 0);
            CHECK((facts.boundary_edges == 0) == (shape != "plane"));
            CHECK(facts.euler == (shape == "torus" ? 0 : shape == "plane" ? 1 : 2));
            CHECK((shape == "plane" || facts.volume > 0));
            for (const Vec3& p : mesh.positions) {
                REQUIRE(off_surface(shape, p) < 1e-15 * 4);
            }
        }
    }
}

TEST_CASE("Volumes of fine samples are those of the shapes") {
    // Chords lie inside by the square of the edge: 1e-3 suffices at 20,000 vertices.
    const auto volume = [](const char* shape) { return test::facts_of(make_sample(shape, 20000)).volume; };
    CHECK(volume("sphere") == Approx(4 * pi / 3).epsilon(1e-3));
    CHECK(volume("cube") == Approx(1).epsilon(1e-12));
    CHECK(volume("cylinder") == Approx(2 * pi * 0.25).epsilon(1e-3));
    CHECK(volume("torus") == Approx(2 * pi * pi * 0.16).epsilon(1e-3));
    const Mesh plane = make_sample("plane", 20000);
    for (const Triangle& t : plane.triangles) {
        const Vec3 normal = glm::cross(plane.positions[t[1]] - plane.positions[t[0]],
                                       plane.positions[t[2]] - plane.positions[t[0]]);
        REQUIRE(normal.z > 0);
    }
}

TEST_CASE("An icosphere of the classic counts is the subdivided icosahedron, well shaped") {
    for (const size_t count : {12, 42, 162, 642, 2562, 40962, 163842}) {
        CHECK(make_sample("icosphere", count).vertex_count() == count);
        CHECK(make_sample("sphere", count).vertex_count() == count);
    }
    CHECK(test::facts_of(make_sample("icosphere", 40962)).min_angle > 45);
    CHECK(test::facts_of(make_sample("sphere", 300)).min_angle > 25);
    CHECK(test::facts_of(make_sample("cylinder", 5000)).min_angle > 20);
    CHECK(test::facts_of(make_sample("torus", 5000)).min_angle > 20);
}

TEST_CASE("Samples are the same every time") {
    for (const char* shape : {"cube", "cylinder", "plane", "sphere", "torus"}) {
        const Mesh a = make_sample(shape, 1500);
        const Mesh b = make_sample(shape, 1500);
        CHECK(a.positions == b.positions);
        CHECK(a.triangles == b.triangles);
    }
}

TEST_CASE("Unknown shapes and impossible counts are refused with what would do") {
    CHECK_THROWS_WITH(make_sample("pyramid", 100),
                      Catch::Contains("pyramid") && Catch::Contains("sphere") && Catch::Contains("torus"));
    CHECK_THROWS_AS(make_sample("", 100), InputError);
    for (const std::string& shape : sample_shape_names()) {
        CHECK_THROWS_WITH(make_sample(shape, 3), Catch::Contains("at least") && Catch::Contains(shape));
        CHECK_THROWS_AS(make_sample(shape, 0), InputError);
        CHECK_THROWS_WITH(make_sample(shape, 50'000'001), Catch::Contains("50000000"));
    }
}

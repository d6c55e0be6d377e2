#include "engine/core/error.h"
#include "engine/mesh/polygonize.h"
#include "tests/support/mesh_checks.h"

#include <catch2/catch.hpp>

using namespace anvil;

namespace {

constexpr double pi = 3.14159265358979323846;

double sphere(const Vec3& p) {
    return glm::length(p) - 1;
}

double box(const Vec3& p, const Vec3& half) {
    const Vec3 q = glm::abs(p) - half;
    return glm::length(glm::max(q, Vec3(0))) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

/// A box with a hole of radius 0.3 drilled along z: genus 1, straight and round sharp edges.
double drilled(const Vec3& p) {
    return std::max(box(p, {0.8, 0.6, 0.5}), 0.3 - std::hypot(p.x, p.y));
}

const Box around{{-1.1, -1.1, -1.1}, {1.1, 1.1, 1.1}};

/// Value without any smoothness: a hash of the rounded place.
double noise(const Vec3& p, uint64_t seed) {
    uint64_t h = seed;
    for (int i = 0; i < 3; ++i) {
        h = (h ^ static_cast<uint64_t>(std::llround(p[i] * 4096) + 100000)) * 0x9E3779B97F4A7C15ULL;
        h ^= h >> 29;
    }
    return static_cast<double>(h % 2001) / 1000.0 - 1;
}

} // namespace

TEST_CASE(
    "A polygonized sphere is closed, manifold, outward, and its volume converges as the square of the cell") {
    double last = 0;
    for (const int cells : {8, 16, 32, 64}) {
        const Mesh mesh = polygonize(sphere, around, {cells, false, true});
        const test::MeshFacts facts = test::facts_of(mesh);
        CHECK(facts.closed_manifold());
        CHECK(facts.euler == 2);
        for (const Vec3& p : mesh.positions) {
            REQUIRE(std::abs(sphere(p)) < 1e-9);
        }
        const double error = 4 * pi / 3 - facts.volume;
        CHECK(error > 0);
        if (last > 0) {
            CHECK(error < 0.35 * last);
        }
        last = error;
    }
}

TEST_CASE("Skipping far cells of a distance bound gives the same mesh as sampling everything") {
    const Mesh all = polygonize(drilled, around, {50, true, false});
    const Mesh near = polygonize(drilled, around, {50, true, true});
    CHECK(test::facts_of(near).closed_manifold());
    REQUIRE(near.vertex_count() == all.vertex_count());
    // The order of the blocks may differ; the set of points may not.
    const auto sum = [](const Mesh& mesh) {
        Vec3 s(0);
        for (const Vec3& p : mesh.positions) {
            s += p;
        }
        return s;
    };
    CHECK(glm::length(sum(all) - sum(near)) < 1e-9);
    CHECK(test::facts_of(near).volume == Approx(test::facts_of(all).volume).epsilon(1e-12));
}

TEST_CASE("Sharp edges and corners come out sharp") {
    const Mesh cube = polygonize(
        [](const Vec3& p) {
            return box(p, {0.8, 0.6, 0.5});
        },
        around, {20, true, true});
    CHECK(test::facts_of(cube).closed_manifold());
    // Planes are met exactly: the volume is that of the box to the precision of the crossings.
    CHECK(test::facts_of(cube).volume == Approx(8 * 0.8 * 0.6 * 0.5).epsilon(1e-6));
    for (const int x : {-1, 1}) {
        double nearest = infinity;
        for (const Vec3& p : cube.positions) {
            nearest = std::min(nearest, glm::distance(p, Vec3(0.8 * x, 0.6, -0.5)));
        }
        CHECK(nearest < 1e-6);
    }
    const Mesh blunt = polygonize(
        [](const Vec3& p) {
            return box(p, {0.8, 0.6, 0.5});
        },
        around, {20, false, true});
    CHECK(test::facts_of(blunt).volume < 0.999 * 8 * 0.8 * 0.6 * 0.5);
}

TEST_CASE("A box with a hole drilled through has genus 1, no vertex far from its surface, and its volume") {
    const Mesh mesh = polygonize(drilled, around, {48, true, true});
    const test::MeshFacts facts = test::facts_of(mesh);
    CHECK(facts.closed_manifold());
    CHECK(facts.euler == 0);
    CHECK(facts.components == 1);
    const double cell = 2.2 / 48;
    // A vertex where planes tangent to the hole meet is off by curvature: cell^2 / (8 radius).
    for (const Vec3& p : mesh.positions) {
        REQUIRE(std::abs(drilled(p)) < cell * cell / (8 * 0.3));
    }
    CHECK(facts.volume == Approx(8 * 0.8 * 0.6 * 0.5 - pi * 0.09).epsilon(0.002));
}

TEST_CASE("Whatever the field, the mesh is closed and manifold") {
    for (uint64_t seed = 0; seed < 12; ++seed) {
        const Mesh mesh =
            polygonize([seed](const Vec3& p) { return noise(p, seed); }, around, {14, seed % 2 == 0, false});
        const test::MeshFacts facts = test::facts_of(mesh);
        REQUIRE(mesh.vertex_count() > 1000);
        CHECK(facts.boundary_edges == 0);
        CHECK(facts.non_manifold_edges == 0);
        CHECK(facts.bow_tie_vertices == 0);
        CHECK(facts.isolated_vertices == 0);
        CHECK(facts.volume > 0);
    }
}

TEST_CASE("A field that breaks the bound it promised still gives a closed mesh") {
    const Mesh mesh = polygonize([](const Vec3& p) { return 30 * drilled(p); }, around, {40, false, true});
    CHECK(test::facts_of(mesh).boundary_edges == 0);
    CHECK(test::facts_of(mesh).non_manifold_edges == 0);
}

TEST_CASE(
    "A solid that reaches out of the box is cut off and closed; values that are not numbers are outside") {
    const Mesh whole = polygonize([](const Vec3&) { return -1.0; }, around, {10, false, true});
    CHECK(test::facts_of(whole).euler == 2);
    CHECK(test::facts_of(whole).boundary_edges == 0);
    const Mesh half =
        polygonize([](const Vec3& p) { return p.x > 0 ? std::nan("") : sphere(p); }, around, {20, true});
    const test::MeshFacts facts = test::facts_of(half);
    CHECK(facts.boundary_edges == 0);
    CHECK(facts.euler == 2);
    CHECK(facts.volume == Approx(2 * pi / 3).epsilon(0.15));
    for (const Vec3& p : half.positions) {
        REQUIRE(is_finite(p));
    }
    CHECK(polygonize([](const Vec3&) { return 1.0; }, around, {10}).vertex_count() == 0);
}

TEST_CASE("Polygonizing is deterministic and refuses boxes and counts that mean nothing") {
    const Mesh a = polygonize(drilled, around, {40, true, true});
    const Mesh b = polygonize(drilled, around, {40, true, true});
    CHECK(a.positions == b.positions);
    CHECK(a.triangles == b.triangles);
    CHECK_THROWS_AS(polygonize(sphere, Box{}, {10}), InputError);
    CHECK_THROWS_AS(polygonize(sphere, Box{Vec3(0), Vec3(1, 0, 1)}, {10}), InputError);
    CHECK_THROWS_AS(polygonize(sphere, around, {0}), InputError);
    CHECK_THROWS_AS(polygonize(sphere, around, {4096}), InputError);
}

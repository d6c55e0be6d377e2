#include "engine/mesh/sample_shapes.h"
#include "engine/occluder/face_orientation.h"
#include "engine/occluder/mesh_distance.h"
#include "tests/support/contact_scene.h"

#include <catch2/catch.hpp>

using namespace anvil;
using test::random_in;

namespace {

/// One in so many faces turned over, the first among them.
std::vector<Triangle> with_turned(std::vector<Triangle> triangles, unsigned one_in) {
    std::mt19937 random(2);
    for (size_t t = 0; t < triangles.size(); ++t) {
        if (t == 0 || random() % one_in == 0) {
            std::swap(triangles[t][1], triangles[t][2]);
        }
    }
    return triangles;
}

} // namespace

TEST_CASE(
    "flipped faces are turned back, on closed and open surfaces and where each face has corners of its own") {
    for (const char* name : {"torus", "plane", "bust", "cube"}) {
        const Mesh mesh = make_sample(name, 600);
        for (const unsigned one_in : {3U, 20U}) {
            CHECK(oriented_alike(mesh.positions, with_turned(mesh.triangles, one_in)) == mesh.triangles);
        }
    }
    const Mesh torus = make_sample("torus", 600);
    std::vector<Vec3> corners;
    std::vector<Triangle> apart;
    for (const Triangle& t : torus.triangles) {
        const auto first = static_cast<uint32_t>(corners.size());
        apart.push_back({first, first + 1, first + 2});
        corners.insert(corners.end(), {torus.positions[t[0]], torus.positions[t[1]], torus.positions[t[2]]});
    }
    CHECK(oriented_alike(corners, with_turned(apart, 4)) == apart);
}

TEST_CASE("what is oriented stays: inverted parts, surfaces twice, a Moebius strip, nothing") {
    Mesh two = make_sample("icosphere", 162);
    const auto count = static_cast<uint32_t>(two.vertex_count());
    const size_t faces = two.triangles.size();
    for (uint32_t v = 0; v < count; ++v) {
        two.positions.push_back(two.positions[v] + Vec3(3, 0, 0));
    }
    for (size_t t = 0; t < faces; ++t) {
        const auto& [a, b, c] = two.triangles[t];
        two.triangles.push_back({c + count, b + count, a + count});
    }
    CHECK(oriented_alike(two.positions, two.triangles) == two.triangles);

    const Mesh plane = make_sample("plane", 100); // twice, with its rim
    std::vector<Triangle> twice = plane.triangles;
    twice.insert(twice.end(), plane.triangles.begin(), plane.triangles.end());
    CHECK(oriented_alike(plane.positions, twice) == twice);

    constexpr uint32_t around = 12;
    std::vector<Vec3> strip;
    std::vector<Triangle> moebius;
    for (uint32_t i = 0; i < around; ++i) {
        const double turn = 2 * 3.14159265358979 * i / around;
        const Vec3 out(std::cos(turn), std::sin(turn), 0);
        const Vec3 across = 0.3 * (std::cos(turn / 2) * out + std::sin(turn / 2) * Vec3(0, 0, 1));
        strip.insert(strip.end(), {out - across, out + across});
        const bool last = i + 1 == around;
        const uint32_t low = last ? 1 : 2 * i + 2; // the other side after once around
        const uint32_t high = last ? 0 : 2 * i + 3;
        moebius.insert(moebius.end(), {Triangle{2 * i, low, high}, Triangle{2 * i, high, 2 * i + 1}});
    }
    CHECK(oriented_alike(strip, moebius) == moebius);
    CHECK(oriented_alike({}, {}).empty());
}

TEST_CASE("a face that is there again, with the same corners or equal ones, is left out") {
    const Mesh mesh = make_sample("torus", 200);
    std::vector<Vec3> positions = mesh.positions;
    std::vector<Triangle> triangles = mesh.triangles;
    const auto count = static_cast<uint32_t>(positions.size());
    positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (const auto& [a, b, c] : mesh.triangles) {
        triangles.insert(triangles.end(), {Triangle{b, c, a}, Triangle{c + count, a + count, b + count}});
    }
    CHECK(each_once(positions, triangles) == mesh.triangles);
    CHECK(each_once(mesh.positions, mesh.triangles) == mesh.triangles);
    // The other side of a sheet is another face.
    const std::vector<Triangle> sheet{{0, 1, 2}, {2, 1, 0}};
    CHECK(each_once(mesh.positions, sheet) == sheet);
    CHECK(each_once({}, {}).empty());
}

TEST_CASE("an open surface that is there twice has the inside that it has alone") {
    Mesh once = make_sample("icosphere", 642);
    std::erase_if(once.triangles, [&](const Triangle& t) { return once.positions[t[0]].y > 0.3; });
    Mesh twice = once;
    twice.triangles.insert(twice.triangles.end(), once.triangles.begin(), once.triangles.end());
    const auto truth = mesh_distance(once);
    const auto solid = mesh_distance(twice);
    std::mt19937 random(5);
    for (int i = 0; i < 3000; ++i) {
        const Vec3 p = random_in(random, Vec3(-1.1), Vec3(1.1));
        CHECK(solid->at(p).distance == truth->at(p).distance);
    }
}

TEST_CASE("a coarse mesh has the inside that it has without its flipped faces, right beside them too") {
    const Mesh whole = make_sample("icosphere", 42);
    Mesh flipped = whole;
    flipped.triangles = with_turned(whole.triangles, 10);
    const auto truth = mesh_distance(whole);
    const auto solid = mesh_distance(flipped);
    std::mt19937 random(3);
    for (int i = 0; i < 3000; ++i) {
        const Vec3 p = random_in(random, Vec3(-1.1), Vec3(1.1));
        CHECK(solid->at(p).distance == truth->at(p).distance);
    }
}

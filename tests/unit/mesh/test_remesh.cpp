#include "engine/core/error.h"
#include "engine/mesh/remesh.h"
#include "engine/mesh/sample_shapes.h"
#include "engine/mesh/triangle_mesh.h"
#include "engine/mesh/triangle_net.h"
#include "tests/support/mesh_checks.h"

#include <catch2/catch.hpp>
#include <random>

using namespace anvil;

namespace {

double torus(const Vec3& p) {
    return std::hypot(std::hypot(p.x, p.z) - 1, p.y) - 0.4;
}

Mesh rough_torus() {
    return polygonize(torus, Box{Vec3(-1.5, -0.5, -1.5), Vec3(1.5, 0.5, 1.5)}, {24});
}

} // namespace

TEST_CASE(
    "Remeshing evens edges and angles, stays on the surface and keeps the topology, finer and coarser") {
    const Mesh rough = rough_torus();
    const Projection project = projection_onto(torus, 1e-4);
    for (const double length : {0.05, 0.1, 0.25}) {
        const Mesh mesh = remesh(rough, project, {length, 8});
        const test::MeshFacts facts = test::facts_of(mesh);
        CAPTURE(length, mesh.vertex_count());
        CHECK(facts.closed_manifold());
        CHECK(facts.euler == 0);
        CHECK(facts.components == 1);
        CHECK(facts.min_angle > 25);
        double mean = 0;
        for (const Triangle& t : mesh.triangles) {
            mean += glm::distance(mesh.positions[t[0]], mesh.positions[t[1]]);
        }
        mean /= static_cast<double>(mesh.triangles.size());
        CHECK(mean == Approx(length).epsilon(0.2));
        for (const Vec3& p : mesh.positions) {
            REQUIRE(std::abs(torus(p)) < 1e-9);
        }
    }
}

TEST_CASE("Remeshing to a count comes within 5 %, by quartering too") {
    const Projection project = projection_onto(torus, 1e-4);
    for (const size_t count : {300, 1234, 50000}) {
        const Mesh mesh = remesh_to_count(rough_torus(), project, count);
        CHECK(static_cast<double>(mesh.vertex_count()) == Approx(static_cast<double>(count)).epsilon(0.05));
        CHECK(test::facts_of(mesh).closed_manifold());
        CHECK(test::facts_of(mesh).min_angle > 15);
    }
}

TEST_CASE("Only closed manifold surfaces can be remeshed") {
    const Projection nothing = [](const Vec3& p) { return p; };
    CHECK_THROWS_AS(remesh(make_sample("plane", 50), nothing, {0.1}), InputError);
    CHECK_THROWS_AS(remesh(make_sample("sphere", 50), nothing, {0}), InputError);
    Mesh turned = make_sample("sphere", 50);
    std::swap(turned.triangles[3][0], turned.triangles[3][1]);
    CHECK_THROWS_AS(remesh(turned, nothing, {0.1}), InputError);
    Mesh bow_tie = make_sample("cube", 8); // two cubes that share a corner
    const Mesh other = bow_tie;
    for (const Vec3& p : other.positions) {
        bow_tie.positions.push_back(p + Vec3(1));
    }
    uint32_t top = 0;
    uint32_t bottom = 0;
    for (uint32_t v = 0; v < 8; ++v) {
        top = other.positions[v] == Vec3(0.5) ? v : top;
        bottom = other.positions[v] == Vec3(-0.5) ? v : bottom;
    }
    for (Triangle t : other.triangles) {
        for (uint32_t& v : t) {
            v = v == bottom ? top : v + 8;
        }
        bow_tie.triangles.push_back(t);
    }
    CHECK_THROWS_AS(remesh(bow_tie, nothing, {0.1}), InputError);
}

TEST_CASE("A net stays closed and manifold under random splits, collapses and flips") {
    TriangleNet net(make_sample("torus", 60));
    std::mt19937 generator(7);
    for (int step = 0; step < 5000; ++step) {
        const uint32_t h = generator() % net.half_edge_count();
        if (!net.is_alive(h)) {
            continue;
        }
        const uint32_t kind = generator() % 3;
        if (kind == 0 && net.vertex_count() < 200) {
            net.split(h, 0.5 * (net.positions[net.from(h)] + net.positions[net.to(h)]));
        } else if (kind == 1 && net.can_collapse(h)) {
            net.collapse(h);
        } else if (kind == 2 && net.can_flip(h)) {
            net.flip(h);
        }
        if (step % 250 == 0) {
            const Mesh mesh = net.to_mesh();
            const test::MeshFacts facts = test::facts_of(mesh);
            REQUIRE(facts.boundary_edges + facts.non_manifold_edges + facts.bow_tie_vertices +
                        facts.isolated_vertices ==
                    0);
            REQUIRE(facts.euler == 0);
            REQUIRE(mesh.vertex_count() == net.vertex_count());
            REQUIRE(mesh.triangles.size() == net.face_count());
        }
    }
    // It can be taken apart to a torus of few vertices, but never to something that is no surface.
    for (int round = 0; round < 50; ++round) {
        for (uint32_t h = 0; h < net.half_edge_count(); ++h) {
            if (net.is_alive(h) && net.can_collapse(h)) {
                net.collapse(h);
            }
        }
    }
    CHECK(net.vertex_count() >= 7);
    CHECK(test::facts_of(net.to_mesh()).euler == 0);
}

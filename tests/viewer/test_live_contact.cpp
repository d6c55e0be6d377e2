#include "app/viewer/conditioning.h"
#include "app/viewer/live_contact.h"
#include "engine/core/error.h"
#include "engine/forge/volume.h"
#include "engine/mesh/sample_shapes.h"

#include <catch2/catch.hpp>
#include <numeric>

using namespace anvil;

namespace {

/// A ball of radius 0.5 at a place.
OccluderSet ball_at(const Vec3& place, const Vec3& origin) {
    Progress progress;
    OccluderSet set;
    Transform pose;
    pose.translate = place;
    add_occluder(set, build_model({SphereShape{0.5}}, {}, progress), "ball", pose, {}, {origin, 4, 1});
    return set;
}

struct Bench {
    Mesh mesh = make_sample("icosphere", 2562);
    Incidence incidence = incident_triangles(mesh.triangles, mesh.positions.size());
    std::vector<uint32_t> moving;
    Vec3 origin{0.25, -0.5, 0.125};

    /// Those of the upper half move.
    Bench() {
        for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
            if (mesh.positions[v].y > 0) {
                moving.push_back(v);
            }
        }
    }
    std::vector<Vec3> ends(const Vec3& by) const {
        std::vector<Vec3> places;
        for (const uint32_t v : moving) {
            places.push_back(mesh.positions[v] + by);
        }
        return places;
    }
    ContactProbe probe() const { return {mesh.triangles, incidence, mesh.positions, moving}; }
};

} // namespace

TEST_CASE("what is inside an occluder is counted, and the deepest of it found") {
    const Bench bench;
    const Vec3 centre(0, 1.4, 0);
    const std::vector<Vec3> ends = bench.ends(Vec3(0, 0.1, 0));
    const LiveContact contact = bench.probe().measure(ball_at(centre, bench.origin), bench.origin, ends);
    // The ball's surface is where it is: what is nearer to its centre is inside, and what is within a
    // thousandth of its size (the box's diagonal) of it touches.
    size_t inside = 0;
    size_t near = 0;
    double deepest = -infinity;
    for (const Vec3& end : ends) {
        const double depth = 0.5 - glm::length(end - centre);
        inside += depth > 0 ? 1 : 0;
        near += depth > -0.0025 ? 1 : 0; // a thousandth of 2 * 0.5 * sqrt(3), and room
        deepest = std::max(deepest, depth);
    }
    REQUIRE(inside > 10);
    CHECK(contact.vertices >= inside);
    CHECK(contact.vertices <= near);
    REQUIRE(contact.vertex);
    CHECK(contact.vertex->depth == Approx(deepest).epsilon(1e-12));
    CHECK(0.5 - glm::length(contact.vertex->position - centre) == Approx(deepest).epsilon(1e-12));
    REQUIRE(contact.triangle);
    CHECK(contact.triangle->depth >= deepest - 1e-12); // its corners are among its places
    CHECK(contact.triangles >= contact.vertices / 2);
    CHECK(contact.marks.size() == contact.vertices);
}

TEST_CASE("an occluder far away touches nothing, and without any there is nothing to touch") {
    const Bench bench;
    const LiveContact far =
        bench.probe().measure(ball_at(Vec3(0, 5, 0), bench.origin), bench.origin, bench.ends(Vec3(0)));
    CHECK(far.vertices == 0);
    CHECK(far.triangles == 0);
    CHECK_FALSE(far.vertex);
    CHECK_FALSE(far.triangle);
    CHECK(bench.probe().measure({}, bench.origin, bench.ends(Vec3(0))).vertices == 0);
}

TEST_CASE("a triangle that an occluder pokes through dips in although no vertex does") {
    // One large triangle past a small ball in its middle.
    const std::vector<Vec3> corners{Vec3(-5, 0, -5), Vec3(5, 0, -5), Vec3(0, 0, 5)};
    const std::vector<Triangle> triangles{{0, 1, 2}};
    const Incidence incidence = incident_triangles(triangles, 3);
    const std::vector<uint32_t> moving{0, 1, 2};
    const ContactProbe probe(triangles, incidence, corners, moving);
    // At one of the places that are looked at: half of the way between two of them is 0.25 of an edge.
    const Vec3 place = 0.25 * corners[0] + 0.25 * corners[1] + 0.5 * corners[2];
    const LiveContact contact = probe.measure(ball_at(place, Vec3(0)), Vec3(0), corners);
    CHECK(contact.vertices == 0);
    CHECK(contact.triangles == 1);
    REQUIRE(contact.triangle);
    CHECK(contact.triangle->depth == Approx(0.5));
}

TEST_CASE("the volume under a drag changes as that of the whole mesh does") {
    const Bench bench;
    const std::vector<Vec3> ends = bench.ends(Vec3(0.02, 0.3, -0.1));
    std::vector<Vec3> after = bench.mesh.positions;
    for (size_t i = 0; i < ends.size(); ++i) {
        after[bench.moving[i]] = ends[i];
    }
    const double truth =
        enclosed_volume(bench.mesh, after) - enclosed_volume(bench.mesh, bench.mesh.positions);
    REQUIRE(std::abs(truth) > 0.1);
    CHECK(bench.probe().volume_change(ends) == Approx(truth).epsilon(1e-11));
}

TEST_CASE("edits whose handles can hardly be told apart are refused with numbers and a way out") {
    CHECK_NOTHROW(refuse_ill_conditioned(1, 1));
    CHECK_NOTHROW(refuse_ill_conditioned(9e5, 900));
    CHECK_THROWS_WITH(refuse_ill_conditioned(infinity, 1, "edit 2"),
                      Catch::StartsWith("edit 2: the handles") && Catch::Contains("radius"));
    CHECK_THROWS_AS(refuse_ill_conditioned(10, 1001), InputError);
}

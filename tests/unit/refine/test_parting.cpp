#include "engine/mesh/sample_shapes.h"
#include "engine/refine/longest_first.h"
#include "engine/refine/space_criterion.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/refine_checks.h"

#include <catch2/catch.hpp>
#include <random>

using namespace anvil;
using namespace anvil::test;

namespace {

using Map = std::function<Vec3(const Vec3&)>;

struct Refined {
    RefinedMesh mesh;
    RefineReport report;
};

/// By what a map of space does to the whole mesh, in place of an edit.
Refined refined_in_space(const Mesh& mesh, const Map& map, double tolerance) {
    const auto criterion = make_space_criterion(
        [&](std::span<const Vec3> places, const std::vector<double>&) {
            std::vector<Vec3> ends;
            std::transform(places.begin(), places.end(), std::back_inserter(ends), map);
            return ends;
        },
        tolerance);
    HandleField everywhere{ShapeFunction(preset_knots("smooth")), 10, 0, {}};
    everywhere.anchors.push_back({std::vector<double>(mesh.vertex_count(), 0), SourceKind::line, {}});
    Progress progress;
    Refinement result =
        refine(mesh.triangles, state_of(mesh, {everywhere}), *criterion, {tolerance, 0, 100000}, progress);
    return {divided(mesh, result.state.parents, result.faces), result.report};
}

/// Largest difference between map and interpolation, by 40 samples of edges longer than `shortest`.
double sampled_miss(const Mesh& mesh, const Map& map, double shortest) {
    double worst = 0;
    for (const Triangle& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            const Vec3& a = mesh.positions[t[i]];
            const Vec3& b = mesh.positions[t[(i + 1) % 3]];
            for (int k = 1; k < 40 && glm::distance(a, b) > shortest; ++k) {
                worst = std::max(
                    worst, glm::distance(map(between(a, b, k / 40.0)), between(map(a), map(b), k / 40.0)));
            }
        }
    }
    return worst;
}

} // namespace

TEST_CASE("Where a map jumps, refinement in space stops at edges as short as the tolerance and counts them") {
    const Mesh mesh = make_sample("plane", 121);
    const double tolerance = 0.02;
    const Map torn = [](const Vec3& p) { return p + Vec3(0, 0, p.x + 0.3 * p.y > 0.0137 ? 0.5 : 0.0); };
    const Refined result = refined_in_space(mesh, torn, tolerance);
    CHECK(result.report.stopped_by == RefineStop::parting);
    CHECK(result.report.max_error <= tolerance);
    CHECK(result.report.parted_error == Approx(0.5).epsilon(0.05));
    // The line is 1.04 long and crossed by about three edges a tolerance; each takes some vertices more.
    CHECK(result.report.parted_edges > 1.04 / tolerance);
    CHECK(result.report.added < 12 * 1.04 / tolerance);
    CHECK(facts_of(result.mesh.mesh).min_angle > 1);
    CHECK(sampled_miss(result.mesh.mesh, torn, tolerance) <= tolerance);
}

TEST_CASE("A map that is steep but does not jump is within the tolerance everywhere") {
    const Mesh mesh = make_sample("plane", 121);
    const double tolerance = 0.02;
    for (const double slope : {1.0, 4.0, 10.0}) {
        const Map ramp = [slope](const Vec3& p) {
            return p + Vec3(0, 0, 0.5 * std::tanh(2 * slope * (p.x + 0.3 * p.y - 0.0137)));
        };
        const Refined result = refined_in_space(mesh, ramp, tolerance);
        INFO("slope " << slope << " added " << result.report.added);
        CHECK(result.report.stopped_by == RefineStop::tolerance);
        CHECK(result.report.parted_edges == 0);
        CHECK(facts_of(result.mesh.mesh).min_angle > 1);
        CHECK(sampled_miss(result.mesh.mesh, ramp, 0) <= 1.02 * tolerance);
    }
}

TEST_CASE("A map that is noise at every scale ends refinement too") {
    const Mesh mesh = make_sample("plane", 36);
    const Map noise = [](const Vec3& p) {
        return p + Vec3(0, 0, 0.05 * std::sin(1e7 * p.x) * std::sin(1.3e7 * p.y));
    };
    const Refined result = refined_in_space(mesh, noise, 0.02);
    CHECK(result.report.stopped_by == RefineStop::parting);
    // Edges of the length of the tolerance: 50 x 50, and some shorter ones.
    CHECK(result.report.added < 6 * 2500);
    CHECK(facts_of(result.mesh.mesh).min_angle > 0.3);
}

TEST_CASE("In a thin face the longest edge is split first, and nothing where it may not be") {
    const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0.5, 0.05, 0}, {0.5, -2, 0}};
    const std::vector<Triangle> triangles{{0, 1, 2}, {1, 0, 3}};
    const EdgeMesh mesh(triangles, std::vector<uint32_t>{0, 1}, positions.size());
    const uint32_t longest = mesh.faces()[0].edges[0];
    const uint32_t flank = mesh.faces()[0].edges[1];
    const auto split = [&](double thinnest, const std::vector<char>& fixed, uint32_t crease) {
        std::vector<EdgeSplit> splits{{flank, 0.4, 7, crease}};
        const GivenWay given =
            put_longest_first(mesh, std::array<uint32_t, 2>{0, 1}, positions, thinnest, fixed, splits);
        return std::pair(splits, given);
    };
    std::vector<char> fixed(mesh.edges().size(), 0);
    const auto [splits, given] = split(0.1, fixed, no_index);
    REQUIRE(splits.size() == 1);
    CHECK(splits[0].edge == longest);
    CHECK(splits[0].place == 0.5);
    CHECK(splits[0].error == 7);
    CHECK(given.later == std::vector<uint32_t>{flank});
    CHECK(split(0.04, fixed, no_index).first[0].edge == flank);
    CHECK(split(0.1, fixed, 0).first[0].edge == flank);
    fixed[longest] = 1;
    const auto [none, blocked] = split(0.1, fixed, no_index);
    CHECK(none.empty());
    CHECK(blocked.blocked == std::vector<uint32_t>{flank});
}

#include "tests/support/forging.h"
#include "tests/support/mesh_checks.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::test;

namespace {

std::string recipe_with(const std::string& occluder, const std::string& edit) {
    return "{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': [ {'name': 'o', " + occluder +
           ", 'influence': {'kind': 'hard'}} ], 'edits': [ " + edit + " ] }";
}

const std::string ceiling = "'shape': {'plane': {'normal': [0,0,-1], 'offset': -0.1}}";

std::string lift_to_ceiling(const std::string& refine) {
    return "{ 'kind': 'translate', 'handles': [ {'at': {'vertex': 60}, 'by': [0,0,0.5]} ], 'radius': 0.33, "
           "'shape': 'plateau', 'refine': " +
           refine + " }";
}

size_t count_new_within(const ForgeResult& result, size_t first, const Vec3& centre, double radius) {
    const auto& p = result.refined->positions;
    return static_cast<size_t>(
        std::count_if(p.begin() + static_cast<std::ptrdiff_t>(first), p.end(),
                      [&](const Vec3& v) { return glm::distance(v, centre) < radius; }));
}

} // namespace

TEST_CASE("In space, what an occluder flattens needs no vertices, and what stands free does") {
    const Mesh mesh = make_sample("plane", 121);
    const double tolerance = 0.004;
    const ForgeResult space = forged_on_cpu(
        mesh, recipe_of(recipe_with(ceiling, lift_to_ceiling("{'criterion': 'space', 'tolerance': 0.004}"))));
    const ForgeResult shape = forged_on_cpu(
        mesh, recipe_of(recipe_with(ceiling, lift_to_ceiling("{'criterion': 'shape', 'tolerance': 0.008}"))));
    REQUIRE(space.refined);
    REQUIRE(shape.refined);
    CHECK(space.parents.size() < shape.parents.size());
    CHECK(space.report.edits[0].refine->stopped_by == "tolerance");
    const ShapeFunction plateau(preset_knots("plateau"));
    const Vec3 centre = mesh.positions[60];
    double worst = 0;
    // The ramp meets the ceiling at alpha 0.2, t 0.98; the kink at t 0.9 lies in the flat.
    const size_t flat = count_new_within(space, mesh.vertex_count(), centre, 0.33 * 0.93);
    CHECK(4 * flat < count_new_within(shape, mesh.vertex_count(), centre, 0.33 * 0.93));
    for (const Triangle& t : space.refined->triangles) {
        for (int i = 0; i < 3; ++i) {
            for (int k = 1; k < 20; ++k) {
                const Vec3 place = between(space.refined->positions[t[i]],
                                           space.refined->positions[t[(i + 1) % 3]], k / 20.0);
                const Vec3 moved = between(space.positions[t[i]], space.positions[t[(i + 1) % 3]], k / 20.0);
                const double alpha = plateau(glm::distance(place, centre) / 0.33);
                const Vec3 wanted(place.x, place.y, std::min(0.1, 0.5 * alpha));
                worst = std::max(worst, glm::distance(moved, wanted));
            }
        }
    }
    // Seven samples an edge see a kink that an occluder makes only to 1/16 of the edge.
    CHECK(worst <= 1.1 * tolerance);
    CHECK(facts_of(*space.refined).euler == facts_of(mesh).euler);
}

TEST_CASE("In space, an edit that only flattens adds no vertex, and one that stops half way does") {
    Mesh mesh = make_sample("plane", 121);
    for (Vec3& p : mesh.positions) {
        p.z = 0.05 + 0.02 * std::sin(9 * p.x) * std::cos(7 * p.y); // 0.03 to 0.07
    }
    const auto pressed_down_to = [&](double height) {
        return forged_on_cpu(
            mesh,
            recipe_of("{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': [ {'name': 'press', 'shape': {'plane': "
                      "{'normal': [0,0,-1]}}, 'influence': {'kind': 'hard'}} ], 'edits': [ {'kind': "
                      "'translate', 'occluders': [ {'name': 'press', 'motion': [ {'at': 0, 'translate': "
                      "[0,0,0.2]}, {'at': 1, 'translate': [0,0," +
                      text(height) + "]} ]} ], 'refine': {'criterion': 'space', 'tolerance': 0.001}} ] }"));
    };
    const ForgeResult flat = pressed_down_to(0.02);
    for (const Vec3& p : flat.positions) {
        REQUIRE(std::abs(p.z - 0.02) <= 1e-6);
    }
    CHECK(!flat.refined);
    CHECK(flat.report.edits[0].refine->max_error <= 0.001);
    CHECK(pressed_down_to(0.05).refined);
}

TEST_CASE("In space, an edit that moves less than the tolerance adds no vertex") {
    const Mesh mesh = make_sample("plane", 121);
    const ForgeResult result = forged_on_cpu(
        mesh, edit_recipe("{ 'kind': 'translate', 'handles': [ {'at': {'vertex': 60}, 'by': [0,0,0.001]} ], "
                          "'radius': 0.33, 'shape': 'plateau', 'refine': {'criterion': 'space', 'tolerance': "
                          "0.002} }"));
    CHECK(!result.refined);
    CHECK(result.report.edits[0].refine->max_error <= 0.002);
}

TEST_CASE("In space, triangles that meet an occluder dip into it by the tolerance at most") {
    const Mesh mesh = make_sample("plane", 121);
    const std::string ball =
        "'shape': {'sphere': {'radius': 0.2}}, 'transform': {'translate': [0.02, 0.01, -0.3]}";
    const auto press = [&](const std::string& refine) {
        return recipe_of(recipe_with(ball, "{ 'kind': 'translate', 'handles': [ {'at': {'vertex': 60}, 'by': "
                                           "[0,0,-0.25]} ], 'radius': 0.45, 'shape': 'smooth'" +
                                               refine + " }"));
    };
    const double tolerance = 0.002;
    const ForgeResult plain = forged_on_cpu(mesh, press(""));
    const ForgeResult space =
        forged_on_cpu(mesh, press(", 'refine': {'criterion': 'space', 'tolerance': 0.002}"));
    REQUIRE(plain.report.edits[0].contact);
    CHECK(plain.report.edits[0].contact->deepest_dip > tolerance);
    CHECK(space.report.edits[0].contact->deepest_dip <= tolerance);
    CHECK(space.report.edits[0].contact->contact_vertices > 10);
    CHECK(space.report.edits[0].refine->stopped_by == "tolerance");
    CHECK(space.report.edits[0].refine->parted_edges == 0);
    // Both at once: never more than either tolerance.
    const ForgeResult both = forged_on_cpu(
        mesh, press(", 'refine': {'criterion': 'both', 'tolerance': {'shape': 0.02, 'space': 0.002}}"));
    CHECK(both.report.edits[0].contact->deepest_dip <= tolerance);
    CHECK(both.report.edits[0].refine->max_error <= 1);
}

TEST_CASE(
    "In space, a plate or a knife that parts a sphere costs few vertices and no slivers, and is reported") {
    const Mesh mesh = make_sample("icosphere", 642);
    const double tolerance = 0.02;
    for (const std::string rounding : {"0", "0.02"}) {
        // Thin in x; beside it the sphere's tip goes on to z = 1.8, before it it stops at 1.2.
        const std::string plate = "'shape': {'box': {'half': [0.02, 1.5, 0.5], 'rounding': " + rounding +
                                  "}}, 'transform': {'translate': [0.013, 0, 1.7]}";
        const ForgeResult result = forged_on_cpu(
            mesh,
            recipe_of(recipe_with(
                plate, "{ 'kind': 'translate', 'handles': [ {'at': {'nearest': [0,0,1]}, 'by': [0,0,0.8]} "
                       "], 'radius': 1.2, 'refine': {'criterion': 'space', 'tolerance': 0.02} }")));
        REQUIRE(result.refined);
        const RefineSummary& refine = *result.report.edits[0].refine;
        INFO("rounding " << rounding << ": " << refine.added << " vertices, least angle "
                         << refine.min_angle_after << ", parted " << refine.parted_edges);
        CHECK(refine.stopped_by == "parting");
        CHECK(refine.max_error <= tolerance);
        CHECK(refine.parted_error > 10 * tolerance);
        // Two lines of length 2, and some twenty vertices a tolerance.
        CHECK(refine.added < 20 * 4 / tolerance / 4);
        CHECK(refine.min_angle_after > 0.5);
        REQUIRE(result.report.warnings.size() == 1);
        CHECK(result.report.warnings[0].find("edits[0]: the surface goes past") == 0);
        CHECK(facts_of(*result.refined).closed_manifold());
        // What is torn lies within the tolerance of a line: no longer edge bridges it.
        double steepest = 0;
        for (const Triangle& t : result.refined->triangles) {
            for (int i = 0; i < 3; ++i) {
                const uint32_t a = t[i], b = t[(i + 1) % 3];
                const double before =
                    glm::distance(result.refined->positions[a], result.refined->positions[b]);
                const double after = glm::distance(result.positions[a], result.positions[b]);
                steepest = before > tolerance ? std::max(steepest, after / before) : steepest;
            }
        }
        CHECK(steepest < 5);
    }
}

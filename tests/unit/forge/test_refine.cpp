#include "engine/core/error.h"
#include "engine/edit/recipe_json.h"
#include "engine/mesh/search_tree.h"
#include "tests/support/forging.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/refine_checks.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::test;

namespace {

/// An edit of the plane (11 x 11) around the place: up by 0.25.
std::string lift(const std::string& at, const std::string& shape, const std::string& rest) {
    return "{ 'kind': 'translate', 'handles': [ {'at': " + at +
           ", 'by': [0,0,0.25]} ], 'radius': 0.33, "
           "'shape': '" +
           shape + "'" + rest + " }";
}

const std::string off_centre = "{'nearest': [0.013, 0.021, 0]}";

} // namespace

TEST_CASE(
    "A refined cone has its tip at the handle and its rim in the mesh, whatever the plane's faces were") {
    const Mesh mesh = make_sample("plane", 121);
    for (const std::string metric : {"geodesic", "euclidean"}) {
        const Recipe recipe = edit_recipe(
            lift(off_centre, "linear", ", 'metric': '" + metric + "', 'refine': {'tolerance': 0.01}"));
        const ForgeResult result = forged_on_cpu(mesh, recipe);
        REQUIRE(result.refined);
        const Mesh& refined = *result.refined;
        REQUIRE(result.positions.size() == refined.vertex_count());
        REQUIRE(result.parents.size() == refined.vertex_count() - mesh.vertex_count());
        CHECK(result.report.vertices == refined.vertex_count());
        REQUIRE(result.report.edits[0].refine);
        CHECK(result.report.edits[0].refine->added == result.parents.size());
        CHECK(result.report.edits[0].refine->stopped_by == "tolerance");
        CHECK(result.report.edits[0].refine->max_error <= 0.01);
        CHECK(result.report.edits[0].refine->min_angle_after > 0);
        const Vec3 tip(0.013, 0.021, 0);
        double nearest = 1;
        HandleField rim{ShapeFunction(preset_knots("linear")), 0.33, 0, {{{}, SourceKind::point, tip}}};
        for (size_t v = 0; v < refined.vertex_count(); ++v) {
            const double d = glm::distance(refined.positions[v], tip);
            nearest = std::min(nearest, d);
            rim.anchors[0].distances.push_back(d);
            // Every vertex stands where the cone is: alpha = 1 - d / R.
            const Vec3 wanted = refined.positions[v] + Vec3(0, 0, 0.25 * std::max(0.0, 1 - d / 0.33));
            CHECK(glm::distance(result.positions[v], wanted) < 1e-9);
        }
        CHECK(nearest < 1e-9);
        const Rim found = rim_of(refined, rim, 0.33, 1e-6 * 0.33);
        CHECK(found.edges > 20);
        CHECK(found.odd_vertices == 0);
        CHECK(found.crossed_triangles == 0);
    }
}

TEST_CASE("The surface between the vertices is where the edit would have moved it") {
    const Mesh mesh = make_sample("plane", 121);
    const double tolerance = 0.005;
    const ForgeResult result =
        forged_on_cpu(mesh, edit_recipe(lift(off_centre, "plateau", ", 'refine': {'tolerance': 0.005}")));
    REQUIRE(result.refined);
    const ShapeFunction shape(preset_knots("plateau"));
    double worst = 0;
    for (const Triangle& t : result.refined->triangles) {
        for (int i = 0; i < 3; ++i) {
            for (const double s : {0.1, 0.25, 0.5, 0.75, 0.9}) {
                const Vec3 place =
                    between(result.refined->positions[t[i]], result.refined->positions[t[(i + 1) % 3]], s);
                const Vec3 moved = between(result.positions[t[i]], result.positions[t[(i + 1) % 3]], s);
                const double alpha = shape(glm::distance(place, Vec3(0.013, 0.021, 0)) / 0.33);
                worst = std::max(worst, std::abs(moved.z - 0.25 * alpha));
            }
        }
    }
    CHECK(worst <= 0.25 * tolerance * 1.01);
    CHECK(worst > 0.25 * tolerance * 0.2);
}

TEST_CASE("Later edits find vertices and faces of the file where they were") {
    const Mesh mesh = make_sample("plane", 121);
    const std::string second = "{ 'kind': 'translate', 'handles': [ {'at': {'face': 90, 'triangle': 0, "
                               "'barycentric': [0.2, 0.3, 0.5]}, 'by': [0,0,0.1]} ], 'radius': 0.2";
    const Recipe both = edit_recipe(lift("{'vertex': 60}", "linear", ", 'refine': {'tolerance': 0.02}") +
                                    ", " + second + " }");
    const ForgeResult result = forged_on_cpu(mesh, both);
    REQUIRE(result.refined);
    // Where the address stands on the file's mesh, the first edit has raised the point to its cone.
    const Triangle& t = mesh.triangles[mesh.first_triangle(90)];
    const Vec3 place = 0.2 * mesh.positions[t[0]] + 0.3 * mesh.positions[t[1]] + 0.5 * mesh.positions[t[2]];
    const double cone = 0.25 * std::max(0.0, 1 - glm::distance(place, mesh.positions[60]) / 0.33);
    CHECK(result.report.edits[1].target_errors[0] < 1e-9);
    const SearchTree surface(result.positions, result.refined->triangles);
    // The face of the refined cone that holds the point is off the cone by the tolerance at most.
    const double off = surface.closest(place + Vec3(0, 0, cone + 0.1)).distance;
    CHECK(off <= 0.25 * 0.02);
    // The same with the second edit refined: the point itself is then a vertex.
    const Recipe refined_twice =
        edit_recipe(lift("{'vertex': 60}", "linear", ", 'refine': {'tolerance': 0.02}") + ", " + second +
                    ", 'refine': {'tolerance': 0.05} }");
    const ForgeResult twice = forged_on_cpu(mesh, refined_twice);
    double nearest = 1;
    for (const Vec3& p : twice.refined->positions) {
        nearest = std::min(nearest, glm::distance(p, place));
    }
    CHECK(nearest < 1e-9);
    CHECK(twice.report.edits[1].refine->added > 0);
    // Vertices that refinement added have no address in the file.
    CHECK_THROWS_AS(forged_on_cpu(mesh, edit_recipe(lift("{'vertex': 60}", "linear", ", 'refine': {}") +
                                                    ", " + lift("{'vertex': 130}", "linear", ""))),
                    InputError);
}

TEST_CASE("Pinned points inside faces are vertices that stay while others move") {
    const Mesh mesh = make_sample("plane", 121);
    const std::string pin = "{'face': 100, 'barycentric': [0.3, 0.3, 0.4]}";
    const ForgeResult result =
        forged_on_cpu(mesh, edit_recipe(lift("{'vertex': 60}", "smooth",
                                             ", 'pinned': [" + pin + "], 'refine': {'tolerance': 0.02}")));
    REQUIRE(result.refined);
    const Triangle& t = mesh.triangles[mesh.first_triangle(100)];
    const Vec3 place = 0.3 * mesh.positions[t[0]] + 0.3 * mesh.positions[t[1]] + 0.4 * mesh.positions[t[2]];
    const uint32_t pinned = nearest_vertex(*result.refined, place);
    CHECK(glm::distance(result.refined->positions[pinned], place) < 1e-9);
    CHECK(result.positions[pinned] == result.refined->positions[pinned]);
}

TEST_CASE("Limits stop refinement, and the report says so") {
    const Mesh mesh = make_sample("plane", 121);
    const ForgeResult full =
        forged_on_cpu(mesh, edit_recipe(lift("{'vertex': 60}", "plateau",
                                             ", 'refine': {'tolerance': 0.001, 'max_vertices': 200}")));
    CHECK(full.refined->vertex_count() == 200);
    CHECK(full.report.edits[0].refine->stopped_by == "max_vertices");
    CHECK(full.report.edits[0].refine->max_error > 0.001);
    CHECK(facts_of(*full.refined).euler == facts_of(mesh).euler);
    const ForgeResult coarse = forged_on_cpu(
        mesh,
        edit_recipe(lift("{'vertex': 60}", "plateau", ", 'refine': {'tolerance': 0.001, 'min_edge': 0.02}")));
    CHECK(coarse.report.edits[0].refine->stopped_by == "min_edge");
    // Cut edges keep to the limit; those across a face that two cuts leave may be shorter, but are old
    // vertices apart or span two cuts.
    for (const VertexParents& p : coarse.parents) {
        const double length = glm::distance(coarse.refined->positions[p.a], coarse.refined->positions[p.b]);
        CHECK(std::min(p.place, 1 - p.place) * length >= 0.02 * (1 - 1e-12));
    }
}

TEST_CASE("An edit that linear interpolation gives exactly adds no vertex") {
    const Mesh mesh = make_sample("plane", 2601);
    const ForgeResult result = forged_on_cpu(
        mesh,
        edit_recipe("{ 'kind': 'translate', 'handles': [ {'at': {'vertex': 60}, 'by': [0,0,1]} ], 'radius': "
                    "10, 'shape': {'knots': [{'t': 0, 'value': 1}, {'t': 0.9, 'value': 1}, {'t': 1, "
                    "'value': 0}]}, 'refine': {} }"));
    CHECK(!result.refined);
    CHECK(result.parents.empty());
    CHECK(result.report.edits[0].refine->added == 0);
}

TEST_CASE("The bundled recipes put sharp features and fine detail on coarse samples") {
    const std::string folder = ANVIL_TEST_DATA "/../../app/example/";
    const ForgeResult features =
        forged_on_cpu(make_sample("icosphere", 162), read_recipe(folder + "sharp_features.json"));
    REQUIRE(features.refined);
    CHECK(facts_of(*features.refined).closed_manifold());
    REQUIRE(features.report.edits.size() == 4);
    for (const EditReport& edit : features.report.edits) {
        CHECK(edit.refine->stopped_by == "tolerance");
        CHECK(edit.refine->max_error <= 0.01);
        CHECK(edit.target_errors[0] < 1e-12);
    }
    const Mesh plane = make_sample("plane", 121);
    CHECK(plane.triangles.size() == 200);
    CHECK(!forged_on_cpu(plane, read_recipe(folder + "fine_detail_unrefined.json")).refined);
    const ForgeResult fine = forged_on_cpu(plane, read_recipe(folder + "fine_detail.json"));
    REQUIRE(fine.refined);
    const ShapeFunction wave(preset_knots("wave"));
    for (size_t v = 0; v < fine.positions.size(); ++v) {
        const double t = glm::distance(fine.refined->positions[v], Vec3(0.02, 0.01, 0)) / 0.45;
        CHECK(fine.positions[v].z == Approx(0.16 * (t < 1 ? wave(t) : 0)).margin(1e-9));
    }
}

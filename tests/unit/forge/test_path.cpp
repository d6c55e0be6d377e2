// Path-tracked drags: the surface follows a handle's path step by step, past the occluders.
#include "tests/support/forging.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::test;

namespace {

/// A unit sheet at z = 0 whose middle square moves as one, under a ball of radius 0.2.
Recipe sheet_recipe(const std::string& target, const Vec3& ball, const std::string& steps = "") {
    return recipe_of(
        "{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': [ {'name': 'ball', 'shape': {'sphere': "
        "{'radius': 0.2}}, 'influence': {'kind': 'hard'}, 'transform': {'translate': " +
        text(ball) + "}} ], 'edits': [ {'kind': 'translate', 'handles': [ {'at': {'nearest': [0,0,0]}, " +
        target + "} ], 'radius': 0.45, 'metric': 'euclidean', 'shape': 'constant'" + steps + "} ] }");
}

const std::string up_and_down = "'path': [[0,0,0], [0,0,0.3], [0,0,0]]";

double depth_in_ball(const Vec3& p, const Vec3& ball) {
    return std::max(0.0, 0.2 - glm::length(p - ball));
}

double largest_change(const ForgeResult& a, const ForgeResult& b) {
    double largest = 0;
    for (size_t v = 0; v < a.positions.size(); ++v) {
        largest = std::max(largest, glm::length(a.positions[v] - b.positions[v]));
    }
    return largest;
}

} // namespace

TEST_CASE("a straight path, corners or not, is the edit that moves by its end") {
    const Mesh mesh = make_sample("plane", 1500);
    const Vec3 ball(0.05, 0, 0.3);
    const auto by = forged_on_cpu(mesh, sheet_recipe("'by': [0,0,0.3]", ball));
    const auto two = forged_on_cpu(mesh, sheet_recipe("'path': [[0,0,0], [0,0,0.3]]", ball));
    const auto four =
        forged_on_cpu(mesh, sheet_recipe("'path': [[0,0,0], [0,0,0.1], [0,0,0.15], [0,0,0.3]]", ball));
    CHECK(by.report.edits[0].contact->contact_vertices > 10);
    CHECK(largest_change(by, two) == 0);
    // The corners add steps, which only refine: the error of the contact itself is 1e-4 here.
    CHECK(largest_change(by, four) < 1e-3);
    CHECK(four.report.edits[0].target_errors[0] < 1e-15);
}

TEST_CASE("a closed path brings free vertices back and leaves aside what it pushed aside") {
    const Mesh mesh = make_sample("plane", 3000);
    const Vec3 ball(0, 0, 0.3);
    const auto result = forged_on_cpu(mesh, sheet_recipe(up_and_down, ball));
    const double band = 0.4 * std::sqrt(3.0) / 128; // where contact acts: diagonal of the ball / 128
    size_t pushed = 0;
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 start = mesh.positions[v];
        const Vec3 change = result.positions[v] - start;
        REQUIRE(is_finite(change));
        const double beside = glm::length(Vec3(start.x, start.y, 0));
        if (beside > 0.2 + band) {
            // Never met: a path that ends at its start is exactly zero there.
            REQUIRE(change == Vec3(0));
            continue;
        }
        // The sheet rose until the vertex met the ball; from there the ball took off what was missing to 0.3.
        // A vertex slides outward while it is held, so that its way is known at the axis alone. Those that
        // only came within the band are held at its edge and released again, up to its curvature.
        REQUIRE(change.z <= (beside > 0.2 ? 1e-3 : 0.0));
        pushed += change.z < -0.01 ? 1 : 0;
        if (beside < 0.01) {
            CHECK(change.z == Approx(-0.2).margin(2e-3));
        }
    }
    CHECK(pushed > 100);
    CHECK(result.report.edits[0].target_errors[0] == 0);
    CHECK(result.report.edits[0].contact->penetrating_vertices == 0);
}

TEST_CASE("a path around the occluder does not touch it, the straight one to the same end does") {
    const Mesh mesh = make_sample("plane", 800);
    const Vec3 ball(0, 0, 0.3);
    const std::string around = "'path': [[0,0,0], [1,0,0], [1,0,0.7], [0,0,0.7]]";
    const auto past = forged_on_cpu(mesh, sheet_recipe(around, ball));
    const auto through = forged_on_cpu(mesh, sheet_recipe("'by': [0,0,0.7]", ball));
    const uint32_t middle = nearest_vertex(mesh, Vec3(0));
    CHECK(glm::length(past.positions[middle] - mesh.positions[middle] - Vec3(0, 0, 0.7)) < 1e-15);
    CHECK(glm::length(through.positions[middle] - mesh.positions[middle] - Vec3(0, 0, 0.7)) > 0.1);
    for (const Vec3& p : through.positions) {
        REQUIRE(depth_in_ball(p, ball) <= 1e-9);
    }
}

TEST_CASE("several paths share normalized arc length: the handles stand on them at every corner") {
    // Two corners at different times; at each the other handle is where its own path is by then. A ball in
    // the way of neither shows the ends alone, so the way is read off the target errors along the paths.
    const Mesh mesh = make_sample("plane", 900);
    const Recipe recipe =
        edit_recipe("{'kind': 'translate', 'radius': 0.8, 'handles': ["
                    "{'at': {'nearest': [-0.2,0,0]}, 'path': [[0,0,0], [0,0,0.3], [0.1,0,0.3]]},"
                    "{'at': {'nearest': [0.2,0,0]}, 'path': [[0,0,0], [0,0.1,0], [0,0.1,0.1], [0,0,0.1]]},"
                    "{'at': {'nearest': [0,0.3,0]}, 'by': [0,0,0.2]} ]}");
    const auto result = forged_on_cpu(mesh, recipe);
    for (const double miss : result.report.edits[0].target_errors) {
        CHECK(miss < 1e-15);
    }
    const Vec3 ends[] = {{0.1, 0, 0.3}, {0, 0, 0.1}, {0, 0, 0.2}};
    const Vec3 starts[] = {{-0.2, 0, 0}, {0.2, 0, 0}, {0, 0.3, 0}};
    for (int i = 0; i < 3; ++i) {
        const uint32_t v = nearest_vertex(mesh, starts[i]);
        CHECK(glm::length(result.positions[v] - mesh.positions[v] - ends[i]) < 0.03);
    }
}

TEST_CASE("equal steps are counted over the whole path, and half of an edit is half of its path") {
    const Mesh mesh = make_sample("plane", 800);
    const Vec3 ball(0.1, 0, 0.35);
    const auto fixed = forged_on_cpu(mesh, sheet_recipe(up_and_down, ball, ", 'steps': {'count': 60}"));
    CHECK(fixed.report.edits[0].steps.max == 60);
    Recipe recipe = sheet_recipe("'path': [[0,0,0], [0,0,0.3], [0.2,0,0.3]]", Vec3(0, 0, 5));
    recipe.edits[0].amount = 0.5;
    const auto half = forged_on_cpu(mesh, recipe);
    const uint32_t middle = nearest_vertex(mesh, Vec3(0));
    CHECK(glm::length(half.positions[middle] - mesh.positions[middle] - Vec3(0.1, 0, 0.15)) < 1e-15);
}

TEST_CASE("a drag past a ball converges with the steps") {
    const Mesh mesh = make_sample("plane", 500);
    const Vec3 ball(0.1, 0.05, 0.3);
    const std::string path = "'path': [[0,0,0], [0,0,0.2], [0.3,0,0.25]]";
    std::vector<ForgeResult> results;
    for (const int count : {100, 200, 400, 3200}) {
        results.push_back(forged_on_cpu(
            mesh, sheet_recipe(path, ball, ", 'steps': {'count': " + std::to_string(count) + "}")));
    }
    const double coarse = largest_change(results[0], results[3]);
    const double middle = largest_change(results[1], results[3]);
    const double fine = largest_change(results[2], results[3]);
    INFO(coarse << " " << middle << " " << fine);
    CHECK(coarse > 1e-6);
    // Order 1: halving the steps halves the error; against 3200 steps the ratio of the last two is 15/7.
    CHECK(middle < 0.65 * coarse);
    CHECK(fine < 0.65 * middle);
}

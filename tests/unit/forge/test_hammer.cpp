// Hammers: occluders that move while an edit acts.
#include "engine/mesh/mesh_writer.h"
#include "engine/occluder/level_set_file.h"
#include "engine/occluder/shape_nodes.h"
#include "tests/support/forging.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <random>

using namespace anvil;
using namespace anvil::test;

namespace {

std::string still(const std::string& shape, const Vec3& at, const std::string& influence = "'hard'") {
    return "{'name': 'tool', 'shape': " + shape + ", 'influence': {'kind': " + influence +
           "}, 'transform': {'translate': " + text(at) + "}}";
}

Recipe hammer_recipe(const std::string& tool, const std::string& motion, const std::string& more = "") {
    return recipe_of("{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': [" + tool +
                     "], 'edits': [ {'kind': 'translate', 'occluders': [ {'name': 'tool', 'motion': [" +
                     motion + "]} ]" + more + "} ] }");
}

std::string two_poses(const Vec3& from, const Vec3& to) {
    return "{'at': 0, 'translate': " + text(from) + "}, {'at': 1, 'translate': " + text(to) + "}";
}

const std::string ball = "{'sphere': {'radius': 0.2}}";

double largest_change(const ForgeResult& a, const ForgeResult& b, const Vec3& shift = Vec3(0)) {
    double largest = 0;
    for (size_t v = 0; v < a.positions.size(); ++v) {
        const double change = glm::length(a.positions[v] - b.positions[v] - shift);
        largest = is_finite(a.positions[v]) ? std::max(largest, change) : infinity;
    }
    return largest;
}

/// The mesh moved as a whole against the tool that stands.
Recipe moved_plate_recipe(const std::string& tool, const Vec3& by, const std::string& more = "") {
    return recipe_of("{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': [" + tool +
                     "], 'edits': [ {'kind': 'translate', 'radius': 100, 'metric': 'euclidean', 'shape': "
                     "{'knots': [{'t': 0, 'value': 1}, {'t': 0.9, 'value': 1}, {'t': 1, 'value': 0}]}, "
                     "'handles': [{'at': {'vertex': 0}, 'by': " +
                     text(by) + "}]" + more + "} ] }");
}

} // namespace

TEST_CASE("a sphere pressed into a plate leaves its shape") {
    const Mesh mesh = make_sample("plane", 4000);
    const Vec3 end(0.03, 0.02, 0.1);
    for (const char* influence : {"'hard'", "'soft'"}) {
        const auto result = forged_on_cpu(
            mesh, hammer_recipe(still(ball, Vec3(0), influence), two_poses({0.03, 0.02, 0.5}, end)));
        size_t contacts = 0;
        size_t beneath = 0;
        for (size_t v = 0; v < mesh.vertex_count(); ++v) {
            const double beside = glm::length(mesh.positions[v] - Vec3(end.x, end.y, 0));
            const double distance = glm::length(result.positions[v] - end) - 0.2;
            REQUIRE(std::isfinite(distance));
            REQUIRE(distance >= -1e-12);
            // The ball's section with the plate has radius 0.173. What lay in the middle of it was met.
            if (beside < 0.1) {
                ++beneath;
                contacts += distance <= 1e-5 * 0.2 ? 1 : 0;
                REQUIRE(result.positions[v].z < 0);
            } else if (beside > 0.2 + 0.1) {
                REQUIRE(distance > 0.05);
            }
            if (beside > 0.45) { // farther than the ball and four sigma
                REQUIRE(result.positions[v] == mesh.positions[v]);
            }
        }
        INFO(influence << ": " << contacts << " of " << beneath);
        CHECK(beneath > 100);
        if (std::string(influence) == "'hard'") {
            CHECK(contacts == beneath);
        }
    }
}

TEST_CASE("hammers of a mesh or of a level set, baked adaptively, leave the shape that the solid leaves") {
    const ScratchFolder folder;
    Mesh tool = make_sample("icosphere", 10242);
    for (Vec3& p : tool.positions) {
        p *= 0.2;
    }
    write_mesh(folder / "ball.ply", tool, tool.positions);
    Progress progress;
    write_level_set(folder / "ball.vdb", *formula_distance(shape_nodes({SphereShape{0.2}})), 0.2 / 48,
                    progress);
    const Mesh mesh = make_sample("plane", 4000);
    const Vec3 end(0.03, 0.02, 0.1);
    const std::string poses = two_poses({0.03, 0.02, 0.5}, end);
    const auto truth = forged_on_cpu(mesh, hammer_recipe(still(ball, Vec3(0)), poses));
    for (const char* kind : {"mesh", "vdb"}) {
        const std::string file = (folder / (kind == std::string("mesh") ? "ball.ply" : "ball.vdb")).string();
        const std::string shape = std::string("{'") + kind + "': '" + file + "'}";
        const std::string field = "'field': {'kind': 'adaptive', 'resolution': 64}, 'influence'";
        std::string occluder = still(shape, Vec3(0));
        occluder.replace(occluder.find("'influence'"), std::string("'influence'").size(), field);
        const auto result = forged_on_cpu(mesh, hammer_recipe(occluder, poses));
        size_t inside = 0;
        double largest = 0;
        for (size_t v = 0; v < mesh.vertex_count(); ++v) {
            REQUIRE(is_finite(result.positions[v]));
            // What is written as faces lies up to a sagitta of 2e-4 radii inside the ball.
            inside += glm::length(result.positions[v] - end) < 0.2 * (1 - 5e-4) ? 1 : 0;
            largest = std::max(largest, glm::length(result.positions[v] - truth.positions[v]));
        }
        CHECK(inside == 0);
        CHECK(largest < 0.4 / 57); // a voxel: what slides over the ball takes another way in a sampled field
    }
}

TEST_CASE("a moving hammer does to a plate what the plate's motion against it would") {
    const Mesh mesh = make_sample("plane", 2500);
    const Vec3 way(0.1, 0.05, -0.4);
    const Vec3 start(0, 0, 0.45);
    for (const std::string& tool :
         std::vector<std::string>{"{'sphere': {'radius': 0.2}}", "{'box': {'half': [0.2,0.1,0.15]}}",
                                  "{'torus': {'major': 0.2, 'minor': 0.07}}"}) {
        for (const char* influence : {"'hard'", "'soft'"}) {
            for (const std::string& steps : std::vector<std::string>{"", ", 'steps': {'count': 200}"}) {
                const auto hammer = forged_on_cpu(
                    mesh, hammer_recipe(still(tool, start, influence), two_poses(start, start + way), steps));
                const auto plate =
                    forged_on_cpu(mesh, moved_plate_recipe(still(tool, start, influence), -way, steps));
                INFO(tool << influence << steps);
                CHECK(hammer.report.edits[0].contact->contact_vertices > 20);
                CHECK(hammer.report.edits[0].steps.max == plate.report.edits[0].steps.max);
                // Rounding of a few hundred steps; ridges multiply it (a box has edges).
                CHECK(largest_change(plate, hammer, -way) < 1e-9);
            }
        }
    }
}

TEST_CASE("hammer and mesh that move together do not meet, and their relative motion is what counts") {
    const Mesh mesh = make_sample("plane", 900);
    const Vec3 start(0, 0, 0.45);
    const Vec3 by(0.3, 0, 0.1);
    Recipe together = moved_plate_recipe(still(ball, start), by);
    const auto with_motion = [&](const Vec3& to) {
        Recipe recipe = together;
        OccluderUse use{"tool", {}, {}, {}};
        use.motion = {{0, start, {}, {}}, {1, to, {}, {}}};
        recipe.edits[0].occluders = {use};
        return forged_on_cpu(mesh, recipe);
    };
    const auto carried = with_motion(start + by);
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        REQUIRE(glm::length(carried.positions[v] - mesh.positions[v] - by) < 1e-15);
    }
    const Vec3 down(0, 0, -0.4);
    const auto hammer =
        forged_on_cpu(mesh, hammer_recipe(still(ball, start), two_poses(start, start + down)));
    CHECK(largest_change(with_motion(start + by + down), hammer, by) < 1e-9);
}

TEST_CASE("what a swelling or shrinking hammer hardly touches ends where it is asked to") {
    const Mesh mesh = make_sample("plane", 900);
    const Vec3 by(0.3, 0, 0.1);
    for (const double scale : {0.5, 2.0}) {
        Recipe recipe = moved_plate_recipe(
            "{'name': 'tool', 'shape': {'sphere': {'radius': 0.1}}, 'influence': {'kind': 'soft', 'sigma': "
            "0.3}, 'transform': {'translate': [0, 0, 1.2]}}",
            by);
        OccluderUse use{"tool", {}, {}, {}};
        use.motion = {{0, Vec3(0, 0, 1.2), {}, 1}, {1, Vec3(0, 0, 1.2), {}, scale}};
        recipe.edits[0].occluders = {use};
        const auto result = forged_on_cpu(mesh, recipe);
        // It comes no nearer than 0.9 = 3 sigma. Slowed by exp(-9) of what it approaches, 0.2 at most.
        for (size_t v = 0; v < mesh.vertex_count(); ++v) {
            REQUIRE(glm::length(result.positions[v] - mesh.positions[v] - by) < 0.2 * std::exp(-9.0));
        }
    }
}

TEST_CASE("a blow converges with the steps") {
    const Mesh mesh = make_sample("plane", 600);
    const Vec3 from(-0.2, 0.03, 0.3);
    const Vec3 to(0.15, 0, 0.05);
    std::vector<ForgeResult> results;
    for (const int count : {100, 200, 400, 3200}) {
        results.push_back(
            forged_on_cpu(mesh, hammer_recipe(still(ball, from), two_poses(from, to),
                                              ", 'steps': {'count': " + std::to_string(count) + "}")));
    }
    const double coarse = largest_change(results[0], results[3]);
    const double middle = largest_change(results[1], results[3]);
    const double fine = largest_change(results[2], results[3]);
    INFO(coarse << " " << middle << " " << fine);
    CHECK(coarse > 1e-6);
    CHECK(middle < 0.65 * coarse); // order 1, against 3200 steps: 15/31, 7/15
    CHECK(fine < 0.65 * middle);
}

TEST_CASE("no vertex passes a thin plate that is swung, thrown or blown up at it") {
    // A plate a quarter of a voxel (or of h) thin beside a cloud of points, which is one side of it.
    const Mesh sphere = make_sample("sphere", 1200);
    const double voxel = 1.2 / 57;
    const std::string thin = "{'box': {'half': [0.6," + text(0.125 * voxel) + ",0.6]}}";
    for (const char* field : {"", ", 'field': {'kind': 'dense', 'resolution': 64}"}) {
        const std::string tool =
            "{'name': 'tool', 'shape': " + thin + field + ", 'influence': {'kind': 'hard'}}";
        for (const std::string& motion :
             {two_poses({0, 1.5, 0}, {0, -3, 0}), two_poses({0, 1.02, 0}, {0.1, 0.3, 0}),
              std::string(
                  "{'at': 0, 'translate': [0,1.6,0]}, {'at': 1, 'translate': [0,0,0], 'rotate': {'axis': "
                  "[0,0,1], 'degrees': 120}}"),
              std::string(
                  "{'at': 0, 'translate': [0,1.3,0], 'scale': 0.2}, {'at': 0.5, 'translate': [0,1.3,0], "
                  "'scale': 2}, {'at': 1, 'translate': [0,0.5,0], 'scale': 1}")}) {
            INFO(motion << field);
            const auto result = forged_on_cpu(sphere, hammer_recipe(tool, motion));
            CHECK(result.report.edits[0].moved > 50);
            CHECK(result.report.edits[0].contact->penetrating_vertices == 0);
            CHECK(result.report.edits[0].steps.limit_reached == 0);
            for (const Vec3& p : result.positions) {
                REQUIRE(is_finite(p));
            }
            // Straight down the plate's side cannot be passed without leaving the plate sideways.
            if (motion.find("rotate") == std::string::npos && motion.find("scale") == std::string::npos) {
                for (size_t v = 0; v < sphere.vertex_count(); ++v) {
                    const Vec3 start = sphere.positions[v];
                    const Vec3 end = result.positions[v];
                    const double level = motion.find("-3") != std::string::npos ? -3 : 0.3;
                    if (std::max(std::abs(start.x), std::abs(start.z)) < 0.4) {
                        REQUIRE(end.y <= level + 1e-9);
                    }
                }
            }
        }
    }
}

TEST_CASE("a paddle that only turns pushes what is in its way to its surface") {
    const Mesh mesh = make_sample("plane", 3000);
    // A blade along x, turned about z through the sheet's middle, stands across the sheet: z = 0 meets it.
    const std::string blade = "{'box': {'half': [0.3,0.02,0.1]}}";
    const std::string turn =
        "{'at': 0, 'rotate': {'axis': [0,0,1], 'degrees': 0}}, {'at': 1, 'rotate': {'axis': "
        "[0,0,1], 'degrees': 60}}";
    const auto result = forged_on_cpu(mesh, hammer_recipe(still(blade, Vec3(0)), turn));
    const double a = glm::radians(60.0);
    const Vec3 along(std::cos(a), std::sin(a), 0);
    const Vec3 across(-std::sin(a), std::cos(a), 0);
    size_t pushed = 0;
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 start = mesh.positions[v];
        const Vec3 end = result.positions[v];
        REQUIRE(is_finite(end));
        const bool inside = std::abs(start.x) < 0.3 && std::abs(start.y) < 0.02;
        const double reach = glm::length(start);
        const double angle = std::atan2(start.y, start.x);
        if (!inside && reach > 0.05 && reach < 0.25 && angle > 0.15 && angle < a - 0.15) {
            // Swept by the blade's front: now on the front, or past its tip.
            ++pushed;
            const double front = glm::dot(end, across) - 0.02;
            REQUIRE(front >= -1e-12);
            if (glm::dot(end, along) < 0.299) {
                REQUIRE(front < 1e-9);
            }
            REQUIRE(std::abs(end.z) < 1e-12);
        }
        if (reach > 0.36 || (reach > 0.15 && angle > a + 0.3 && angle < 2.8)) {
            REQUIRE(end == start);
        }
    }
    CHECK(pushed > 50);
    CHECK(result.report.edits[0].contact->penetrating_vertices == 0);
}

TEST_CASE("a hammer acts within its anchors' radius, never on pinned points, and by its share") {
    const Mesh mesh = make_sample("plane", 2000);
    const std::string blow = two_poses({0, 0, 0.5}, {0, 0, 0.05});
    const auto near = forged_on_cpu(
        mesh,
        hammer_recipe(still(ball, Vec3(0)), blow,
                      ", 'anchors': [{'at': [{'nearest': [0,0,0]}]}], 'radius': 0.1, 'pinned': [{'nearest': "
                      "[0.05,0,0]}]"));
    const uint32_t pinned = nearest_vertex(mesh, Vec3(0.05, 0, 0));
    CHECK(near.positions[pinned] == mesh.positions[pinned]);
    size_t moved = 0;
    for (size_t v = 0; v < mesh.vertex_count(); ++v) {
        const bool moves = near.positions[v] != mesh.positions[v];
        moved += moves ? 1 : 0;
        REQUIRE((!moves || glm::length(mesh.positions[v]) <= 0.1 * (1 + 1e-12)));
    }
    CHECK(moved > 20);
    Recipe half = hammer_recipe(still(ball, Vec3(0)), two_poses({0, 0, 0.5}, {0, 0, -0.4}));
    half.edits[0].amount = 0.5;
    const auto full = forged_on_cpu(mesh, hammer_recipe(still(ball, Vec3(0)), blow));
    CHECK(largest_change(forged_on_cpu(mesh, half), full) < 1e-9);
    half.edits[0].amount = 0;
    CHECK(forged_on_cpu(mesh, half).report.edits[0].moved == 0);
}

TEST_CASE("between hammer and anvil a vertex stays outside both where there is room") {
    const Mesh mesh = make_sample("plane", 1500);
    const Recipe recipe =
        recipe_of("{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': ["
                  "{'name': 'tool', 'shape': {'sphere': {'radius': 0.2}}, 'influence': {'kind': 'hard'}},"
                  "{'name': 'anvil', 'shape': {'plane': {'normal': [0,0,1], 'offset': -0.05}}, 'influence': "
                  "{'kind': 'hard'}}],"
                  "'edits': [ {'kind': 'translate', 'occluders': ['anvil', {'name': 'tool', 'motion': [" +
                  two_poses({0.02, 0.01, 0.4}, {0.02, 0.01, 0.17}) + "]}]} ] }");
    const auto result = forged_on_cpu(mesh, recipe);
    CHECK(result.report.edits[0].contact->penetrating_vertices == 0);
    double lowest = 0;
    for (const Vec3& p : result.positions) {
        lowest = std::min(lowest, p.z);
        REQUIRE(glm::length(p - Vec3(0.02, 0.01, 0.17)) >= 0.2 - 1e-9);
    }
    CHECK(lowest >= -0.05 - 1e-9);
    CHECK(lowest < -0.02);
}

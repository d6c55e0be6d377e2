#include "engine/deform/contact_finish.h"
#include "tests/support/forging.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace anvil;
using namespace anvil::test;

namespace {

/// A sphere's top pushed down through what is below, by `length`.
std::string push_down(double length) {
    return "{'kind': 'translate', 'radius': 1.2, 'handles': [ {'at': {'nearest': [0,1,0]}, 'by': [0," +
           text(-length) + ",0]} ] }";
}

Recipe with_occluder(const std::string& occluder, const std::string& edit) {
    return recipe_of("{ 'anvil': 1, 'mesh': 'm', 'occluders': [ {'name': 'o', " + occluder +
                     "} ], 'edits': [ " + edit + " ] }");
}

} // namespace

TEST_CASE("displacements up to ten occluder sizes end outside every shape, exact and baked") {
    const Mesh mesh = make_sample("icosphere", 642);
    const std::vector<std::string> shapes{"'shape': {'sphere': {'radius': 0.1}}",
                                          "'shape': {'box': {'half': [0.1,0.06,0.1], 'rounding': 0.02}}",
                                          "'shape': {'cylinder': {'radius': 0.1, 'height': 0.1}}",
                                          "'shape': {'capsule': {'radius': 0.05, 'height': 0.1}}",
                                          "'shape': {'cone': {'radius': 0.1, 'height': 0.15}}",
                                          "'shape': {'torus': {'major': 0.1, 'minor': 0.03}}"};
    for (const std::string& shape : shapes) {
        for (const char* field : {"", ", 'field': {'kind': 'dense', 'resolution': 64}"}) {
            for (double length : {0.25, 1.0, 2.5}) { // 1, 4 and 10 sizes
                INFO(shape << field << ", " << length);
                const ForgeResult result = forged_on_cpu(
                    mesh, with_occluder(shape + field + ", 'transform': {'translate': [0.05,0.7,0.02]}",
                                        push_down(length)));
                const ContactReport& contact = *result.report.edits[0].contact;
                CHECK(contact.penetrating_vertices == 0);
                CHECK(contact.max_penetration <= 1e-6 * 0.25);
                for (const Vec3& p : result.positions) {
                    REQUIRE(is_finite(p));
                }
            }
        }
    }
}

TEST_CASE("as the displacement goes to zero, so does what an edit with an occluder changes") {
    const Mesh mesh = make_sample("icosphere", 642);
    for (const char* field : {"", ", 'field': {'kind': 'dense', 'resolution': 64}"}) {
        // The ball touches the top from outside.
        const std::string ball =
            std::string("'shape': {'sphere': {'radius': 0.3}}, 'transform': {'translate': [0,1.3,0]}") +
            field;
        for (double length : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.1}) {
            const ForgeResult result = forged_on_cpu(mesh, with_occluder(ball, push_down(-length)));
            double farthest = 0;
            for (size_t v = 0; v < mesh.vertex_count(); ++v) {
                farthest = std::max(farthest, glm::length(result.positions[v] - mesh.positions[v]));
            }
            INFO(length << field);
            CHECK(farthest <= length * (1 + 1e-9) + 4e-16); // positions near 1 are rounded
        }
    }
}

TEST_CASE("a mesh of float coordinates, a million units from the origin, deforms as its copy at the origin") {
    // Cells of 1/16: a grid that float holds at a million units too, so that both meshes are alike.
    Mesh near;
    constexpr int side = 40;
    const Vec3 far(1e6, -1e6, 5e5);
    for (int y = 0; y <= side; ++y) {
        for (int x = 0; x <= side; ++x) {
            near.positions.emplace_back(x / 16.0, y / 16.0, 0);
            if (x < side && y < side) {
                const auto corner = static_cast<uint32_t>(near.positions.size() - 1);
                const uint32_t square[] = {corner, corner + 1, corner + side + 2, corner + side + 1};
                near.add_polygon(square);
            }
        }
    }
    triangulate(near);
    Mesh moved = near;
    for (Vec3& p : moved.positions) {
        p += far;
        REQUIRE(p == Vec3(glm::vec3(p)));
    }
    const auto recipe = [](const Vec3& origin) {
        return with_occluder("'shape': {'sphere': {'radius': 0.4}}, 'transform': {'translate': " +
                                 text(origin + Vec3(1.25, 1.25, 0.7)) + "}",
                             "{'kind': 'translate', 'radius': 1, 'handles': [ {'at': {'vertex': 840}, 'by': "
                             "[0,0,0.8]} ] }");
    };
    const ForgeResult a = forged_on_cpu(near, recipe(Vec3(0)));
    const ForgeResult b = forged_on_cpu(moved, recipe(far));
    CHECK(a.report.edits[0].contact->contact_vertices > 0);
    for (size_t v = 0; v < near.vertex_count(); ++v) {
        // A displacement at the region's rim that is smaller than the spacing of doubles there is none.
        if (a.moved[v] != b.moved[v]) {
            CHECK(glm::length(a.positions[v] - near.positions[v]) < 1.2e-10);
        }
        // Doubles at 1e6 are 1.2e-10 apart; contact amplifies the rounding of the ball's place a little.
        CHECK(glm::length(b.positions[v] - far - a.positions[v]) < 1e-8);
    }
}

TEST_CASE("the report has every key of the specification, with and without occluders") {
    const Mesh mesh = make_sample("icosphere", 162);
    const std::string ball = "'shape': {'sphere': {'radius': 0.3}}";
    const ForgeResult with = forged_on_cpu(mesh, with_occluder(ball, push_down(0.2)));
    const ForgeResult without = forged_on_cpu(mesh, edit_recipe(push_down(0.2)));
    const auto check_keys = [](const nlohmann::json& object, std::initializer_list<const char*> keys) {
        for (const char* key : keys) {
            INFO(key);
            CHECK(object.contains(key));
        }
    };
    for (const ForgeResult* result : {&with, &without}) {
        const nlohmann::json report = nlohmann::json::parse(report_json(result->report));
        check_keys(report, {"device", "driver", "vertices", "faces", "seconds", "edits", "warnings"});
        check_keys(report["seconds"],
                   {"load", "distance", "solve", "refine", "bake", "upload", "deform", "download", "write"});
        const nlohmann::json& edit = report["edits"][0];
        check_keys(edit, {"kind", "moved", "rank", "condition", "amplification", "handles", "steps",
                          "samples", "refine", "occluder", "volume"});
        check_keys(edit["handles"][0], {"target_error"});
        check_keys(edit["steps"], {"min", "mean", "max", "limit_reached"});
        check_keys(edit["refine"],
                   {"added", "max_error", "stopped_by", "min_angle_before", "min_angle_after"});
        check_keys(edit["occluder"],
                   {"started_inside", "penetrating_vertices", "max_penetration", "penetrating_triangles",
                    "deepest_dip", "finished_on_cpu", "contact_vertices"});
        check_keys(edit["volume"], {"before", "after"});
    }
}

TEST_CASE("an edit that moves nothing changes no later edit, and errors name recipe and place") {
    const Mesh mesh = make_sample("icosphere", 642);
    std::string still = push_down(0.3);
    still.insert(still.size() - 1, ", 'amount': 0");
    const ForgeResult both = forged_on_cpu(mesh, edit_recipe(still + ", " + push_down(0.3)));
    CHECK(both.report.edits[0].moved == 0);
    CHECK(both.positions == forged_on_cpu(mesh, edit_recipe(push_down(0.3))).positions);
    CHECK_THROWS_WITH(forged_on_cpu(mesh, edit_recipe(still + ", {'kind': 'translate', 'handles': [ {'at': "
                                                              "{'vertex': 642}, 'by': [0,1,0]} ]}")),
                      Catch::StartsWith("test.json: edits[1].handles[0].at: vertex 642"));
}

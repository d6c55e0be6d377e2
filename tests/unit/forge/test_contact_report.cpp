// What touches which occluder.
#include "tests/support/forging.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace anvil;
using namespace anvil::test;

namespace {

/// A ball pressed into a sphere that stands on a floor without being moved by it.
Recipe ball_and_floor() {
    return recipe_of(
        "{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': ["
        "{'name': 'floor', 'shape': {'plane': {'normal': [0,1,0], 'offset': -1}}, 'influence': {'kind': "
        "'hard'}},"
        "{'name': 'ball', 'shape': {'sphere': {'radius': 0.4}}, 'influence': {'kind': 'hard'}}], 'edits': "
        "[ {'kind': 'translate', 'occluders': ['floor', {'name': 'ball', 'motion': [{'at': 0, "
        "'translate': [0,0,1.6]}, {'at': 1, 'translate': [0,0,1.2]}]}]} ] }");
}

double distance_to(const std::string& name, const Vec3& p) {
    return name == "floor" ? p.y + 1 : glm::length(p - Vec3(0, 0, 1.2)) - 0.4;
}

} // namespace

TEST_CASE("contacts are the vertices at each occluder's surface, and triangles with a point there") {
    const Mesh mesh = make_sample("sphere", 3000);
    const auto result = forged_on_cpu(mesh, ball_and_floor());
    const EditReport& report = result.report.edits[0];
    REQUIRE(report.contacts.size() == 2);
    CHECK(report.contacts[0].name == "floor");
    CHECK(report.contacts[1].name == "ball");
    std::vector<bool> either(mesh.vertex_count(), false);
    for (const ContactList& list : report.contacts) {
        // 1e-3 of the size: of the mesh for the plane, of the ball's box for the ball.
        const double near = 1e-3 * (list.name == "floor" ? bounds(mesh).diagonal() : 0.8 * std::sqrt(3.0));
        INFO(list.name);
        CHECK(list.vertices.size() > (list.name == "floor" ? 0U : 20U));
        std::vector<uint32_t> expected;
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            if (distance_to(list.name, result.positions[v]) <= near * (1 + 1e-9)) {
                expected.push_back(v);
                either[v] = true;
            }
        }
        CHECK(list.vertices == expected);
        CHECK(std::is_sorted(list.triangles.begin(), list.triangles.end()));
        std::vector<bool> listed(mesh.triangles.size(), false);
        for (const auto& [face, triangle] : list.triangles) {
            REQUIRE(face < mesh.polygon_count());
            listed[mesh.first_triangle(face) + triangle] = true;
        }
        for (size_t t = 0; t < mesh.triangles.size(); ++t) {
            bool corner = false;
            double least = infinity;
            double longest = 0;
            for (int i = 0; i < 3; ++i) {
                const uint32_t v = mesh.triangles[t][i];
                corner = corner || std::binary_search(expected.begin(), expected.end(), v);
                least = std::min(least, distance_to(list.name, result.positions[v]));
                longest = std::max(longest, glm::length(result.positions[v] -
                                                        result.positions[mesh.triangles[t][(i + 1) % 3]]));
            }
            REQUIRE((!corner || listed[t]));
            REQUIRE((!listed[t] || least <= near + longest));
        }
    }
    CHECK(result.touching == either);
}

TEST_CASE("the report's text lists contacts by occluder") {
    const auto result = forged_on_cpu(make_sample("sphere", 1000), ball_and_floor());
    const auto json = nlohmann::json::parse(report_json(result.report));
    const auto& contacts = json["edits"][0]["occluder"]["contacts"];
    REQUIRE(contacts.size() == 2);
    CHECK(contacts[1]["name"] == "ball");
    CHECK(contacts[1]["vertices"].size() == result.report.edits[0].contacts[1].vertices.size());
    CHECK(contacts[1]["triangles"].at(0).size() == 2);
    CHECK(json["edits"][0]["dilation"].is_null());
}

#include "engine/mesh/sample_bodies.h"
#include "tests/support/forging.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::test;

namespace {

/// A vertex of the palm side and one of the back, opposite each other across a finger.
struct Pair {
    uint32_t front;
    uint32_t back;

    double thickness(std::span<const Vec3> positions) const {
        return glm::length(positions[front] - positions[back]);
    }
};

/// Across the finger at `along` of the way between its joints `from` and `from + 1`.
Pair across(const Mesh& mesh, const sample::FingerLine& finger, int from, double along) {
    const Vec3 middle = glm::mix(finger.joints[from], finger.joints[from + 1], along);
    const double radius = glm::mix(finger.radii[from], finger.radii[from + 1], along);
    return {nearest_vertex(mesh, middle + Vec3(0, 0, radius)),
            nearest_vertex(mesh, middle - Vec3(0, 0, radius))};
}

} // namespace

TEST_CASE("the bundled example closes five fingers around the ball: none inside, none flattened") {
    const Mesh mesh = make_sample("hand", 20000);
    const Recipe recipe = read_recipe(ANVIL_TEST_DATA "/../../app/example/hand_and_ball.json");
    const ForgeResult result = forged_on_cpu(mesh, recipe);
    const Vec3 ball = recipe.occluders[0].transform.translate;
    const double radius = std::get<SphereShape>(recipe.occluders[0].shape.solid).radius;
    for (const Vec3& p : result.positions) {
        REQUIRE(glm::length(p - ball) >= radius - 1e-6 * 2 * radius);
    }
    const auto tips = hand_finger_tips();
    for (size_t f = 0; f < 5; ++f) {
        INFO("finger " << f);
        const uint32_t tip = nearest_vertex(mesh, tips[f]);
        CHECK(glm::length(result.positions[tip] - ball) < glm::length(mesh.positions[tip] - ball));
        CHECK(glm::length(result.positions[tip] - ball) < 2 * radius);
        for (const double along : {0.3, 0.5, 0.7}) {
            const Pair pair = across(mesh, sample::hand_fingers()[f], 2, along);
            CHECK(pair.thickness(result.positions) >= 0.7 * pair.thickness(mesh.positions));
        }
    }
}

TEST_CASE("a finger pressed half its thickness into a ball keeps 70 % of it when soft, half when hard") {
    const Mesh mesh = make_sample("hand", 20000);
    const sample::FingerLine& finger = sample::hand_fingers()[2];
    const Pair pair = across(mesh, finger, 1, 0.5);
    const double thickness = pair.thickness(mesh.positions);
    const Vec3 pad = mesh.positions[pair.front];
    const double radius = 0.15;
    const Vec3 ball = pad + Vec3(0, 0, radius + 0.5 * thickness); // half a thickness away
    const auto kept = [&](const std::string& influence) {
        const ForgeResult result = forged_on_cpu(
            mesh,
            recipe_of("{ 'anvil': 1, 'mesh': 'm', 'occluders': [ {'name': 'ball', 'shape': {'sphere': "
                      "{'radius': " +
                      text(radius) + "}}, 'transform': {'translate': " + text(ball) +
                      "}, 'influence': " + influence +
                      "} ], 'edits': [ {'kind': 'translate', 'radius': 0.5, 'shape': 'plateau', 'handles': [ "
                      "{'at': {'vertex': " +
                      std::to_string(pair.front) + "}, 'by': [0,0," + text(thickness) + "]} ] } ] }"));
        CHECK(result.report.edits[0].contact->penetrating_vertices == 0);
        return pair.thickness(result.positions) / thickness;
    };
    CHECK(kept("{'kind': 'soft', 'sigma': " + text(2 * thickness) + "}") >= 0.7);
    CHECK(kept("{'kind': 'hard'}") == Approx(0.5).margin(0.03));
}

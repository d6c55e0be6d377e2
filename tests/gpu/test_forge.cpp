// Recipes forged on the device against the double reference.
#include "engine/edit/shape_function.h"
#include "engine/gpu/gpu_backend.h"
#include "tests/gpu/gpu_test.h"
#include "tests/support/forging.h"

#include <catch2/catch.hpp>
#include <random>

using namespace anvil;
using namespace anvil::test;

namespace {

class Dice {
  public:
    explicit Dice(uint32_t seed) : engine_(seed) {}
    double between(double low, double high) { return low + (high - low) * engine_() / 4294967296.0; }
    uint32_t below(uint32_t n) { return engine_() % n; }
    Vec3 vector(double size) {
        const double x = between(-size, size);
        const double y = between(-size, size);
        const double z = between(-size, size);
        return {x, y, z};
    }
    template <size_t n>
    std::string one_of(const char* const (&choices)[n]) {
        return choices[below(static_cast<uint32_t>(n))];
    }

  private:
    std::mt19937 engine_;
};

std::string random_handles(Dice& dice, const Mesh& mesh, uint32_t k, bool rotate) {
    std::string handles;
    for (uint32_t i = 0; i < k; ++i) {
        handles +=
            std::string(i > 0 ? ", " : "") +
            "{'at': {'vertex': " + std::to_string(dice.below(static_cast<uint32_t>(mesh.vertex_count()))) +
            "}, " +
            (rotate ? "'degrees': " + text(dice.between(-70, 70)) : "'by': " + text(dice.vector(0.4))) + "}";
    }
    return handles;
}

std::string random_occluder(Dice& dice, uint32_t i) {
    const std::string shape = dice.one_of(
        {"{'sphere': {'radius': 0.3}}", "{'box': {'half': [0.3,0.2,0.25], 'rounding': 0.05}}",
         "{'capsule': {'radius': 0.15, 'height': 0.4}}", "{'torus': {'major': 0.3, 'minor': 0.1}}",
         "{'cylinder': {'radius': 0.2, 'height': 0.5}}", "{'cone': {'radius': 0.3, 'height': 0.5}}",
         "{'plane': {'normal': [0.2,1,0.1], 'offset': -0.9}}"});
    const bool plane = shape.find("plane") != std::string::npos;
    const std::string field =
        !plane && dice.below(3) == 0 ? ", 'field': {'kind': 'dense', 'resolution': 64}" : "";
    const std::string influence =
        dice.one_of({"{'kind': 'hard'}", "{'kind': 'soft', 'sigma': 0.05}",
                     "{'knots': [{'t': 0, 'value': 0.9}, {'t': 1, 'value': 0}], 'width': 0.2}"});
    return "{'name': 'o" + std::to_string(i) + "', 'shape': " + shape + field +
           ", 'influence': " + influence +
           ", 'transform': {'translate': " + text(plane ? Vec3(0) : dice.vector(1)) +
           ", 'rotate': {'axis': [1,2,3], 'degrees': " + text(plane ? 0 : dice.between(0, 360)) +
           "}, 'scale': " + text(dice.between(0.7, 1.3)) + "}}";
}

Recipe random_recipe(uint32_t seed, const Mesh& mesh) {
    Dice dice(seed);
    const bool rotate = dice.below(2) == 0;
    const std::string occluders =
        random_occluder(dice, 0) + (dice.below(2) == 0 ? ", " + random_occluder(dice, 1) : "");
    const uint32_t k = 1 + dice.below(4);
    return recipe_of("{ 'anvil': 1, 'mesh': 'm', 'occluders': [ " + occluders + " ], 'edits': [ { 'kind': " +
                     (rotate ? "'rotate', 'axis': {'origin': [0.2,0,0], 'direction': [1,1,0]}, 'sweep': " +
                                   dice.one_of({"'arc'", "'chord'"})
                             : "'translate'") +
                     ", 'radius': " + text(dice.between(0.5, 1.5)) + ", 'least_squares': true, 'shape': " +
                     dice.one_of({"'smooth'", "'linear'", "'sharp'", "'wave'"}) + ", 'handles': [ " +
                     random_handles(dice, mesh, k, rotate) + " ] } ] }");
}

/// Whether the double result at `v` moves by more than 1e-4 of the diagonal when its input moves by 4 float
/// ulps.
bool bifurcates(const Mesh& mesh, const Recipe& recipe, uint32_t v, double diagonal) {
    const Vec3 truth = forged_on_cpu(mesh, recipe).positions[v];
    for (uint32_t seed = 0; seed < 8; ++seed) {
        Dice dice(seed);
        Mesh nudged = mesh;
        for (Vec3& p : nudged.positions) {
            p += dice.vector(4 * 0x1p-23);
        }
        if (glm::length(forged_on_cpu(nudged, recipe).positions[v] - truth) > 1e-4 * diagonal) {
            return true;
        }
    }
    return false;
}

} // namespace

TEST_CASE("random recipes end on the GPU where they end in double, but for vertices that bifurcate") {
    const CheckedDevice device;
    const auto gpu = make_gpu_backend(device.shared());
    size_t vertices = 0;
    size_t bifurcating = 0;
    for (uint32_t seed = 1; seed <= 12; ++seed) {
        const Mesh mesh = make_sample(seed % 3 == 0 ? "torus" : seed % 3 == 1 ? "sphere" : "hand", 2003);
        const Recipe recipe = random_recipe(seed, mesh);
        Log log;
        const ForgeResult reference = forged_on_cpu(mesh, recipe);
        const ForgeResult result = forged(mesh, recipe, *gpu, log);
        const double diagonal = bounds(mesh).diagonal();
        const double lipschitz = std::max(1.0, make_shape_function(recipe.edits[0].shape).lipschitz());
        const double amplification = std::max(1.0, reference.report.edits[0].amplification);
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            REQUIRE(is_finite(result.positions[v]));
            if (glm::length(result.positions[v] - reference.positions[v]) >
                5e-6 * diagonal * lipschitz * amplification) {
                INFO("seed " << seed << ", vertex " << v << ": "
                             << glm::length(result.positions[v] - reference.positions[v]) / diagonal);
                CHECK(bifurcates(mesh, recipe, v, diagonal));
                ++bifurcating;
            }
        }
        vertices += mesh.vertex_count();
        CHECK(result.report.edits[0].contact->penetrating_vertices == 0);
        CHECK(reference.report.edits[0].contact->penetrating_vertices == 0);
    }
    CHECK(bifurcating <= vertices / 1000);
}

TEST_CASE(
    "handles land on the GPU within a millionth of the diagonal, one, four and sixteen, moved and turned") {
    const CheckedDevice device;
    const auto gpu = make_gpu_backend(device.shared());
    const Mesh mesh = make_sample("sphere", 3001);
    size_t checked = 0;
    for (uint32_t round = 0; round < 6; ++round) {
        Dice dice(100 + round);
        const bool rotate = round % 2 == 1;
        const uint32_t k = round < 2 ? 1 : round < 4 ? 4 : 16;
        const Recipe recipe =
            edit_recipe("{ 'kind': '" + std::string(rotate ? "rotate" : "translate") + "', 'radius': 0.8, " +
                        (rotate ? "'axis': {'origin': [0,0,0], 'direction': [0,1,1]}, " : "") +
                        "'handles': [ " + random_handles(dice, mesh, k, rotate) + " ] }");
        Log log;
        const ForgeResult reference = forged_on_cpu(mesh, recipe);
        const ForgeResult result = forged(mesh, recipe, *gpu, log);
        if (reference.report.edits[0].amplification > 10) {
            continue;
        }
        for (const Handle& handle : recipe.edits[0].handles) {
            const uint32_t v = std::get<VertexAddress>(handle.at).vertex;
            CHECK(glm::length(result.positions[v] - reference.positions[v]) <= 1e-6 * 3.5);
            ++checked;
        }
    }
    CHECK(checked >= 10);
}

TEST_CASE("a mesh a million units away deforms on the GPU as well as one at the origin") {
    const CheckedDevice device;
    const auto gpu = make_gpu_backend(device.shared());
    const Mesh mesh = make_sample("sphere", 3001);
    const Vec3 far(1e6, -1e6, 1e6);
    Mesh moved = mesh;
    for (Vec3& p : moved.positions) {
        p += far;
    }
    const auto recipe = [](const Vec3& ball) {
        return recipe_of("{ 'anvil': 1, 'mesh': 'm', 'occluders': [ {'name': 'ball', 'shape': {'sphere': "
                         "{'radius': 0.3}}, "
                         "'transform': {'translate': " +
                         text(ball) +
                         "}, 'influence': {'kind': 'hard'}} ], 'edits': [ {'kind': 'translate', 'radius': "
                         "0.9, 'handles': [ "
                         "{'at': {'vertex': 7}, 'by': [0.3,-0.2,0.5]} ] } ] }");
    };
    const Vec3 ball = 1.5 * mesh.positions[7] + Vec3(0.1, 0, 0);
    Log log;
    const ForgeResult here = forged(mesh, recipe(ball), *gpu, log);
    const ForgeResult there = forged(moved, recipe(ball + far), *gpu, log);
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        // The input itself is rounded to 1e-10 out there.
        CHECK(glm::length(there.positions[v] - far - here.positions[v]) < 5e-6 * 3.5);
        if (!here.moved[v]) {
            CHECK(!there.moved[v]);
        }
    }
}

// The float loops are yardsticks: they must do the reference's work, not less of it.
#include "engine/deform/float_loop.h"
#include "tests/support/contact_scene.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::test;

namespace {

/// Points above a soft ball that are pushed down onto and past it.
Scene press(FieldKind field) {
    Scene scene;
    scene.fixed_steps = true;
    scene.steps = 200;
    scene.occluders = {{SphereShape{0.5}, {field, 48}, {}, {InfluenceKind::soft, 0.9, 0.05, {}, 0}}};
    std::mt19937 random(30);
    for (int i = 0; i < 1001; ++i) {
        scene.points.push_back(random_in(random, {-0.6, 0.8, -0.6}, {0.6, 1.3, 0.6}));
        scene.displacements.push_back({0.1, -1.5, 0.05});
    }
    return scene;
}

/// Twice what selftest allows, of the diagonal of mesh and path: a single precision path is held against a
/// double one that takes the same steps.
constexpr double allowed = 2 * 5e-6 * 4;

struct Difference {
    size_t non_finite = 0;
    size_t beyond = 0;
    size_t touched = 0;
    size_t other_steps = 0;
};

Difference difference(const SceneResult& a, const SceneResult& b) {
    Difference found;
    for (size_t i = 0; i < a.ends.size(); ++i) {
        found.non_finite += is_finite(a.ends[i]) && is_finite(b.ends[i]) ? 0 : 1;
        found.beyond += glm::length(a.ends[i] - b.ends[i]) <= allowed ? 0 : 1;
        found.touched += (b.results[i].flags & kernel::f64::VERTEX_TOUCHED) != 0 ? 1 : 0;
        found.other_steps += a.results[i].steps != b.results[i].steps ? 1 : 0;
    }
    return found;
}

} // namespace

TEST_CASE("the float loops end where the double reference ends, plain and with AVX2") {
    for (const FieldKind field : {FieldKind::exact, FieldKind::dense, FieldKind::adaptive}) {
        const Scene scene = press(field);
        const SceneResult truth = run_scene(scene, *make_cpu_backend(), false);
        for (const bool widest : {false, true}) {
            INFO("field " << static_cast<int>(field) << ", AVX2 " << (widest && has_avx2_float_loop()));
            const SceneResult found = run_scene(scene, *make_float_cpu_backend(widest), false);
            const Difference d = difference(found, truth);
            CHECK(d.non_finite == 0);
            CHECK(d.touched > 300);
            CHECK(d.beyond <= 2);        // 1 %: a ridge between the two occluders parts neighbours
            CHECK(d.other_steps <= 100); // a skip that ends between two steps goes either way
        }
    }
}

TEST_CASE("every step of a fixed grid is taken where none may be left out, to the same end") {
    Scene scene = press(FieldKind::exact);
    for (const bool single : {false, true}) {
        INFO("float " << single);
        const auto backend = single ? make_float_cpu_backend() : make_cpu_backend();
        scene.every_step = false;
        const SceneResult skipping = run_scene(scene, *backend, false);
        scene.every_step = true;
        const SceneResult stepping = run_scene(scene, *backend, false);
        size_t fewer = 0;
        for (size_t i = 0; i < scene.points.size(); ++i) {
            CHECK(stepping.results[i].steps == 200);
            CHECK(stepping.results[i].samples >= 200);
            fewer += skipping.results[i].steps < 200 ? 1 : 0;
        }
        CHECK(fewer > 900);
        const Difference d = difference(skipping, stepping);
        CHECK(d.non_finite == 0);
        CHECK(d.beyond <= 2);
    }
}

TEST_CASE("a float session refuses what does not fit and what is not yet there") {
    const Scene scene = press(FieldKind::exact);
    const DeformInput input = scene_input(scene, occluder_set(scene));
    const auto session = make_float_cpu_backend()->prepare(input);
    CHECK_THROWS_AS(session->download(), InternalError);
    DeformMotion motion = scene_motion(scene);
    motion.targets.pop_back();
    CHECK_THROWS_AS(session->update(motion), InternalError);
}

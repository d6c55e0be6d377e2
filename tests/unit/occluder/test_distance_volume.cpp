#include "engine/core/error.h"
#include "engine/occluder/distance_volume.h"
#include "engine/occluder/occluder_kernel.h"
#include "engine/occluder/shape_nodes.h"
#include "tests/support/contact_scene.h"

#include <catch2/catch.hpp>

using namespace anvil;
using test::random_in;

TEST_CASE("a baked field is the exact distance at voxel centres and near it between them") {
    Progress progress;
    const auto exact = formula_distance(shape_nodes(OccluderShape{SphereShape{0.5}}));
    const DistanceVolume volume = bake(*exact, 64, progress);
    CHECK(*std::max_element(volume.size.begin(), volume.size.end()) == 64);
    CHECK(volume.error > 0);
    CHECK(volume.error <= 0.25 * volume.voxel);
    std::mt19937 random(1);
    double worst = 0;
    for (int i = 0; i < 5000; ++i) {
        const Vec3 p = random_in(random, -volume.half_size, volume.half_size);
        const double d = volume.texel(0.5 * p / volume.half_size + Vec3(0.5)).w;
        if (std::abs(exact->at(p).distance) < 2 * volume.voxel) {
            worst = std::max(worst, std::abs(d - exact->at(p).distance));
        }
    }
    // Curvature 1/r: three parabolas of height h^2 / 8r each at most.
    CHECK(worst < 3 * volume.voxel * volume.voxel / (8 * 0.5 - 16 * volume.voxel));
}

TEST_CASE("halving the voxels quarters the interpolation error of a smooth solid") {
    Progress progress;
    const auto exact = formula_distance(shape_nodes(OccluderShape{TorusShape{0.6, 0.25}}));
    const double coarse = bake(*exact, 7 + 64, progress).error; // 7 of the voxels are padding
    const double fine = bake(*exact, 7 + 128, progress).error;
    CHECK(coarse / fine > 3.2);
    CHECK(coarse / fine < 5);
}

TEST_CASE("beyond its box a sampled field bounds the distance from below and never lies about the side") {
    Progress progress;
    const auto model = build_model(OccluderShape{SphereShape{0.5}}, {FieldKind::dense, 48}, progress);
    kernel::f64::OccluderKernel kernel;
    kernel.nodes = model.nodes.data();
    kernel.volumes = model.volumes.data();
    std::mt19937 random(2);
    for (int i = 0; i < 3000; ++i) {
        const Vec3 p = random_in(random, Vec3(-4), Vec3(4));
        const double truth = glm::length(p) - 0.5;
        const auto probe = kernel.shape_probe(0, 1, p);
        CHECK(probe.distance <= truth + model.volumes[0]->error);
        if (std::abs(truth) > model.volumes[0]->error) {
            CHECK((probe.distance < 0) == (truth < 0));
        }
        CHECK(std::abs(glm::length(probe.normal) - 1) < 1e-12);
    }
}

TEST_CASE("baking an unbounded or empty solid is refused with a reason") {
    Progress progress;
    CHECK_THROWS_AS(build_model(OccluderShape{PlaneShape{}}, {FieldKind::dense, 64}, progress), InputError);
    const CsgShape nothing{CsgOperation::intersect,
                           {{"", SphereShape{1}, {}}, {"", SphereShape{1}, {{5, 0, 0}}}}};
    CHECK_THROWS_AS(build_model(OccluderShape{nothing}, {FieldKind::dense, 64}, progress), InputError);
}

TEST_CASE("baking can be cancelled") {
    Progress progress;
    progress.cancel();
    CHECK_THROWS_AS(build_model(OccluderShape{SphereShape{1}}, {FieldKind::dense, 64}, progress), Cancelled);
}

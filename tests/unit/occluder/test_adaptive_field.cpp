#include "engine/core/error.h"
#include "engine/mesh/lasting_search.h"
#include "engine/mesh/sample_shapes.h"
#include "engine/occluder/adaptive_field.h"
#include "engine/occluder/brick_tree.h"
#include "engine/occluder/mesh_distance.h"
#include "engine/occluder/occluder_kernel.h"
#include "engine/occluder/shape_nodes.h"
#include "tests/support/contact_scene.h"
#include "tests/support/failing_search.h"

#include <atomic>
#include <catch2/catch.hpp>

using namespace anvil;
using test::random_in;

namespace {

std::shared_ptr<const ExactDistance> exact_of(const OccluderShape& shape) {
    return formula_distance(shape_nodes(shape));
}

const OccluderShape ball{SphereShape{0.5}};
const OccluderShape ring{TorusShape{0.6, 0.25}};
const OccluderShape block{BoxShape{Vec3(0.5, 0.3, 0.2), 0}};

/// Level of the brick that covers a point of the field's box.
uint32_t level_at(const AdaptiveField& field, const Vec3& p) {
    const Vec3 place = (p - field.centre + field.half_size) / (field.voxel * brick_cells);
    size_t index = 0;
    for (int i = 2; i >= 0; --i) {
        index = index * field.grid[i] + std::min(static_cast<uint32_t>(place[i]), field.grid[i] - 1);
    }
    return field.words[index] >> kernel::f64::BRICK_LEVEL_SHIFT;
}

/// A solid that counts how often it is asked.
class Counted final : public ExactDistance {
  public:
    explicit Counted(std::shared_ptr<const ExactDistance> solid) : solid_(std::move(solid)) {}
    SignedDistance at(const Vec3& p) const override {
        ++count_;
        return solid_->at(p);
    }
    Box bounds() const override { return solid_->bounds(); }
    size_t count() const { return count_; }

  private:
    std::shared_ptr<const ExactDistance> solid_;
    mutable std::atomic<size_t> count_{0};
};

} // namespace

TEST_CASE("an adaptive field is within its tolerance of the exact distance, everywhere in its box") {
    for (const OccluderShape& shape : {ball, ring, block}) {
        Progress progress;
        const auto exact = exact_of(shape);
        const AdaptiveField field = bake_adaptive(*exact, 96, progress);
        std::mt19937 random(1);
        size_t beyond = 0;
        size_t far_beyond = 0;
        double band = 0;
        size_t in_band = 0;
        for (int i = 0; i < 40000; ++i) {
            const Vec3 p = random_in(random, field.centre - field.half_size, field.centre + field.half_size);
            const double truth = exact->at(p).distance / field.voxel;
            const double error = field.texel(p).w / field.voxel - truth;
            REQUIRE(std::isfinite(error));
            // The finest cells, which cannot be split, are off by up to 1/4 at edges, 1/2 at corners.
            const double allowed = level_at(field, p) > 0 ? adaptive_tolerance(truth) : 0.5;
            beyond += std::abs(error) > allowed ? 1 : 0;
            far_beyond += std::abs(error) > 2 * allowed ? 1 : 0;
            if (std::abs(truth) < 3) {
                ++in_band;
                band += error * error;
            }
        }
        CHECK(beyond <= 12); // 3e-4 of the points: creases between the places that are tested
        CHECK(far_beyond == 0);
        CHECK(std::sqrt(band / static_cast<double>(in_band)) < 0.041);
    }
}

TEST_CASE("where a soft influence pushes, the normals of coarse bricks are near those of a rough solid") {
    Mesh mesh = make_sample("sphere", 6000);
    const double radius = glm::length(mesh.positions.front());
    std::mt19937 random(9);
    for (Vec3& p : mesh.positions) {
        p *= 1 + std::uniform_real_distribution<double>(-0.006, 0.006)(random);
    }
    Progress progress;
    const auto solid = mesh_distance(mesh);
    const AdaptiveField field = bake_adaptive(*solid, 160, progress);
    const double width = default_soft_width * 0.5 * solid->bounds().diagonal();
    size_t seen = 0;
    size_t beyond = 0;
    for (int i = 0; i < 40000; ++i) {
        const Vec3 direction = glm::normalize(random_in(random, Vec3(-1), Vec3(1)));
        const Vec3 p = (radius + std::uniform_real_distribution<double>(0, 0.5 * width)(random)) * direction;
        if (level_at(field, p) == 0) {
            continue;
        }
        const Vec3 n = glm::normalize(Vec3(field.texel(p)));
        REQUIRE(is_finite(n));
        ++seen;
        // Up to half the width they are held to 0.055 exp(0.39) = 0.08 at the places that are tested; beside
        // them a crease turns them by half as much again.
        beyond += glm::length(n - solid->at(p).normal) > 0.12 ? 1 : 0;
    }
    CHECK(seen > 300);
    CHECK(static_cast<double>(beyond) <
          0.014 * static_cast<double>(seen)); // 0.02 where distances alone count
}

TEST_CASE("an adaptive field takes a fraction of the samples and of the memory of a dense one") {
    Progress progress;
    const Counted ring_counted(exact_of(ring));
    const AdaptiveField field = bake_adaptive(ring_counted, 128, progress);
    const VoxelGrid dense = voxel_grid(ring_counted.bounds(), 128);
    const size_t voxels = size_t{dense.size[0]} * dense.size[1] * dense.size[2];
    CHECK(ring_counted.count() < 2 * voxels);      // most of a box around a ring is near it
    CHECK(field.bytes() < voxels * sizeof(float)); // a quarter of what the dense texture takes
    CHECK(field.voxel == dense.voxel);
}

TEST_CASE("where bricks of different levels meet, a field has no crack") {
    for (const OccluderShape& shape : {ball, ring, block}) {
        Progress progress;
        const AdaptiveField field = bake_adaptive(*exact_of(shape), 64, progress);
        std::mt19937 random(2);
        const Vec3 low = field.centre - field.half_size;
        size_t between_levels = 0;
        for (int i = 0; i < 60000; ++i) {
            Vec3 p = random_in(random, low, field.centre + field.half_size);
            const int axis = i % 3;
            const double width = field.voxel * brick_cells;
            p[axis] = low[axis] + width * std::round((p[axis] - low[axis]) / width);
            Vec3 other = p;
            p[axis] -= 1e-9 * field.voxel;
            other[axis] += 1e-9 * field.voxel;
            if (std::min(p[axis] - low[axis], low[axis] + 2 * field.half_size[axis] - other[axis]) < 0) {
                continue;
            }
            between_levels += level_at(field, p) != level_at(field, other) ? 1 : 0;
            const double a = field.texel(p).w / field.voxel;
            const double b = field.texel(other).w / field.voxel;
            // Both sides are rounded to half a unit, the unit 1 / 2047 of at most twice the largest distance
            // in the brick, which is its diagonal from the value here: with cells of up to 8 voxels 55.
            CHECK(std::abs(a - b) <= 1e-8 + 2 * (std::abs(a) + 55) / kernel::f64::BRICK_DISTANCES);
        }
        CHECK(between_levels > 500);
    }
}

TEST_CASE("the normals of an adaptive field are those of the solid") {
    Progress progress;
    const auto exact = exact_of(ring);
    const AdaptiveField field = bake_adaptive(*exact, 96, progress);
    std::mt19937 random(3);
    for (int i = 0; i < 20000; ++i) {
        const Vec3 p = random_in(random, field.centre - field.half_size, field.centre + field.half_size);
        const SignedDistance truth = exact->at(p);
        if (std::abs(truth.distance) < 0.1) {
            const Vec3 n = glm::normalize(Vec3(field.texel(p)));
            // Stored to 1/511, and turning by a cell of 2 voxels over a radius of 0.25 - 0.1.
            CHECK(glm::length(n - truth.normal) < 0.01 + 2 * field.voxel / 0.15);
        }
    }
}

TEST_CASE("a sample's word gives back normal and distance as stored") {
    kernel::f64::OccluderKernel kernel;
    const auto direction = [](const glm::dvec4& sample) { return glm::normalize(Vec3(sample)); };
    // Octahedral (-1, 0) is -x, and a corner of the square is -z.
    const auto side = kernel.brick_sample(0x201U << 12 | 0xffeU);
    CHECK(side.w == -2);
    CHECK(glm::length(direction(side) - Vec3(-1, 0, 0)) < 1e-15);
    const auto back = kernel.brick_sample(0x1ffU << 22 | 0x1ffU << 12 | 0x7ffU);
    CHECK(back.w == 2047);
    CHECK(glm::length(direction(back) - Vec3(0, 0, -1)) < 1e-15);
    CHECK(glm::length(direction(kernel.brick_sample(0U)) - Vec3(0, 0, 1)) < 1e-15);
    for (uint32_t word = 0; word < 1U << 20; word += 1021) {
        const auto sample = kernel.brick_sample(word << 12);
        CHECK(sample.w == 0);
        CHECK(std::abs(glm::length(Vec3(sample)) / kernel::f64::BRICK_NORMALS - 1) < 0.07);
    }
}

TEST_CASE("the finest samples of an adaptive field are those of a dense one") {
    size_t compared = 0;
    for (const OccluderShape& shape : {ball, ring, block}) {
        for (const uint32_t resolution : {61, 64}) {
            Progress progress;
            const auto exact = exact_of(shape);
            const AdaptiveField field = bake_adaptive(*exact, resolution, progress);
            const DistanceVolume volume = bake(*exact, resolution, progress);
            const Vec3 low = field.centre - field.half_size;
            const Vec3 first = (volume.centre - volume.half_size - low) / field.voxel;
            const CellIndex shift(glm::round(first));
            CHECK(glm::length(first - Vec3(shift)) < 1e-9);
            for (uint32_t z = 0; z < volume.size[2]; ++z) {
                for (uint32_t y = 0; y < volume.size[1]; ++y) {
                    for (uint32_t x = 0; x < volume.size[0]; ++x) {
                        const CellIndex at = shift + CellIndex(x, y, z);
                        const Vec3 p = low + field.voxel * Vec3(at);
                        const bool on_face = at.x % 4 == 0 || at.y % 4 == 0 || at.z % 4 == 0; // stitched
                        if (on_face || level_at(field, p) > 0) {
                            continue;
                        }
                        ++compared;
                        const float* texel = &volume.texels[volume.texel_index(x, y, z)];
                        const glm::dvec4 found = field.texel(p);
                        // Distances are rounded to half a unit, 1/2047 of at most the brick's largest
                        // distance, which is its diagonal from this one; normals to half a unit of 1/511 in
                        // each coordinate of the square, which the map to the sphere stretches by up to 3.
                        const double largest = std::abs(texel[3]) + std::sqrt(3.0) * 4 * field.voxel;
                        CHECK(std::abs(found.w - texel[3]) <= largest / 2047);
                        const Vec3 normal(texel[0], texel[1], texel[2]);
                        CHECK(glm::length(glm::normalize(Vec3(found)) - normal) < 3 * std::sqrt(0.5) / 511);
                    }
                }
            }
        }
    }
    CHECK(compared > 1000);
}

TEST_CASE("beyond its box an adaptive field bounds the distance from below and never lies about the side") {
    Progress progress;
    const auto model = build_model(ball, {FieldKind::adaptive, 48}, progress);
    kernel::f64::OccluderKernel kernel;
    kernel.nodes = model.nodes.data();
    kernel.field_words = model.field->words.data();
    std::mt19937 random(4);
    for (int i = 0; i < 3000; ++i) {
        const Vec3 p = random_in(random, Vec3(-4), Vec3(4));
        const double truth = glm::length(p) - 0.5;
        const auto probe = kernel.shape_probe(0, 1, p);
        const double off = model.field->voxel * adaptive_tolerance(truth / model.field->voxel);
        CHECK(probe.distance <= truth + off);
        if (std::abs(truth) > off) {
            CHECK((probe.distance < 0) == (truth < 0));
        }
        CHECK(std::abs(glm::length(probe.normal) - 1) < 1e-12);
    }
}

TEST_CASE("an edit against an adaptive field ends where it ends against a dense one") {
    const auto exact = exact_of(ring);
    std::mt19937 random(5);
    test::Scene scene;
    while (scene.points.size() < 2000) {
        const Vec3 p = random_in(random, Vec3(-1), Vec3(1));
        if (exact->at(p).distance > 0) {
            scene.points.push_back(p);
            scene.displacements.push_back(random_in(random, Vec3(-0.7), Vec3(0.7)));
        }
    }
    for (const InfluenceKind influence : {InfluenceKind::hard, InfluenceKind::soft}) {
        std::vector<std::vector<Vec3>> ends;
        double voxel = 0;
        double sigma = 0;
        for (const FieldKind kind : {FieldKind::dense, FieldKind::adaptive}) {
            scene.occluders = {{ring, {kind, 128}, {}, {influence, 0.9, {}, {}, 0}}};
            const test::SceneResult result = test::run_scene(scene, *make_cpu_backend(), true);
            voxel = 2 * result.input.occluders.occluders[0].step;
            sigma = result.input.occluders.occluders[0].width;
            ends.push_back(result.ends);
            for (const Vec3& end : result.ends) {
                CHECK(exact->at(end).distance >= -1e-6 * 2);
            }
        }
        std::vector<double> differences;
        for (size_t i = 0; i < scene.points.size(); ++i) {
            differences.push_back(glm::length(ends[0][i] - ends[1][i]) / voxel);
        }
        std::sort(differences.begin(), differences.end());
        // Near the surface the fields differ by rounding alone; soft influence looks farther, as far as the
        // tolerance is larger. What slides far or past a ridge multiplies that: the last few per cent.
        const double reach = influence == InfluenceKind::soft ? kernel::f64::SOFT_REACH * sigma / voxel : 0;
        CHECK(differences[differences.size() / 2] < adaptive_tolerance(0));
        CHECK(differences[differences.size() * 97 / 100] < adaptive_tolerance(reach));
    }
}

TEST_CASE("a plate thinner than a voxel lets nothing through, adaptively baked") {
    const OccluderShape plate{BoxShape{Vec3(1, 1, 0.25 / 57), 0}};
    test::Scene scene;
    scene.occluders = {{plate, {FieldKind::adaptive, 64}}};
    std::mt19937 random(6);
    for (int i = 0; i < 1000; ++i) {
        scene.points.push_back(random_in(random, Vec3(-0.8, -0.8, 0.1), Vec3(0.8, 0.8, 0.6)));
        scene.displacements.push_back(Vec3(0, 0, -1.5) + random_in(random, Vec3(-0.1), Vec3(0.1)));
    }
    const test::SceneResult result = test::run_scene(scene, *make_cpu_backend(), true);
    const double voxel = 2 * result.input.occluders.occluders[0].step;
    CHECK(0.5 / 57 < 0.3 * voxel);
    for (const Vec3& end : result.ends) {
        CHECK(end.z >= 0.25 / 57 - 1e-6);
    }
}

TEST_CASE("an adaptive field scales and moves with its solid") {
    Progress progress;
    Mesh mesh = make_sample("torus", 400);
    const AdaptiveField small = bake_adaptive(*mesh_distance(mesh), 40, progress);
    for (Vec3& p : mesh.positions) {
        p = 1024.0 * p + Vec3(4096, 0, -8192); // without rounding, but for the sums'
    }
    const AdaptiveField large = bake_adaptive(*mesh_distance(mesh), 40, progress);
    CHECK(large.grid == small.grid);
    CHECK(large.voxel == Approx(1024 * small.voxel));
    std::mt19937 random(7);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p = random_in(random, small.centre - small.half_size, small.centre + small.half_size);
        const double d = large.texel(1024.0 * p + Vec3(4096, 0, -8192)).w / 1024;
        // A half may round the other way; octants at their tolerance may be split in one field only.
        CHECK(std::abs(d - small.texel(p).w) <=
              0.1 * small.voxel * adaptive_tolerance(small.texel(p).w / small.voxel));
    }
}

TEST_CASE("an adaptive bake of what is unbounded is refused, and every bake can be cancelled") {
    Progress progress;
    CHECK_THROWS_AS(build_model(OccluderShape{PlaneShape{}}, {FieldKind::adaptive, 64}, progress),
                    InputError);
    progress.cancel();
    CHECK_THROWS_AS(build_model(ball, {FieldKind::adaptive, 64}, progress), Cancelled);
}

TEST_CASE("a field baked with a device's help is the same, also where the device fails in between") {
    Progress progress;
    const auto solid = mesh_distance(make_sample("bust", 800));
    const AdaptiveField field = bake_adaptive(*solid, 40, progress);
    const DistanceVolume volume = bake(*solid, 24, progress);
    for (const int calls : {1000, 0, 1, 2, 7}) { // that the device lasts
        FailingSearchDevice device(calls);
        Log log;
        LastingSearchDevice lasting(device, log);
        CHECK(bake_adaptive(*solid, 40, progress, &lasting).words == field.words);
        CHECK(bake(*solid, 24, progress, &lasting).texels == volume.texels);
        CHECK((device.searched() > 0) == (calls > 1));
        CHECK(log.warnings.size() == (calls < 1000 ? 1 : 0));
    }
    FailingSearchDevice device(3); // without anyone to catch it
    CHECK_THROWS_AS(bake_adaptive(*solid, 40, progress, &device), DeviceError);
}

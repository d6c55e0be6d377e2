#include "engine/core/error.h"
#include "engine/gpu/gpu_backend.h"
#include "engine/gpu/search_device.h"
#include "engine/gpu/selftest.h"
#include "engine/mesh/sample_shapes.h"
#include "engine/occluder/adaptive_field.h"
#include "engine/occluder/distance_volume.h"
#include "engine/occluder/mesh_distance.h"
#include "tests/gpu/gpu_test.h"

#include <random>

using namespace anvil;

namespace {

std::vector<Vec3> points_around(const Mesh& mesh, size_t count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anywhere(-0.3, 0.3);
    std::vector<Vec3> points;
    for (size_t i = 0; i < count; ++i) {
        const double x = anywhere(random);
        const double y = anywhere(random);
        const Vec3 beside(x, y, anywhere(random));
        points.push_back(mesh.positions[random() % mesh.vertex_count()] + (i % 4 == 0 ? 5.0 : 0.3) * beside);
    }
    return points;
}

/// A sample body with a hole, flipped faces and faces twice, anywhere.
Mesh damaged(const Vec3& moved) {
    Mesh mesh = make_sample("bust", 800);
    mesh.triangles.erase(mesh.triangles.begin() + 100, mesh.triangles.begin() + 110);
    for (size_t t = 0; t < mesh.triangles.size(); t += 20) {
        std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
    }
    mesh.triangles.insert(mesh.triangles.end(), mesh.triangles.begin(), mesh.triangles.begin() + 50);
    for (Vec3& p : mesh.positions) {
        p += moved;
    }
    return mesh;
}

} // namespace

TEST_CASE("a device finds the triangles nearest to points, in one go and in many") {
    const CheckedDevice device;
    const Mesh mesh = make_sample("bust", 3000);
    const SearchTree tree(mesh.positions, mesh.triangles);
    const NarrowTree narrow = tree.narrowed();
    const std::vector<Vec3> points = points_around(mesh, 3001);
    std::vector<glm::vec3> local;
    std::transform(points.begin(), points.end(), std::back_inserter(local),
                   [&](const Vec3& p) { return narrow.local(p); });
    std::vector<NearSlots> once;
    for (const uint64_t bytes : {uint64_t{16} << 20, uint64_t{20000}}) { // all, and 560 at a time
        const auto searching = make_search_device(device.shared(), {.chunk_bytes = bytes});
        const auto search = searching->put(narrow);
        REQUIRE(search);
        std::vector<NearSlots> found(points.size());
        REQUIRE(search->find(local, found));
        REQUIRE((once.empty() || found == once));
        once = found;
    }
    size_t wrong = 0;
    size_t unknown = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        const auto end = std::find(once[i].begin(), once[i].end(), kernel::f32::NO_TRIANGLE);
        const ClosestPoint of_these = tree.closest_of(points[i], {once[i].begin(), end});
        const ClosestPoint truth = tree.closest(points[i]);
        unknown += of_these.found() ? 0 : 1;
        wrong += of_these.found() && of_these.distance != truth.distance ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(unknown < points.size() / 100);
}

TEST_CASE("a device bakes the fields that the CPU bakes, signs of damaged meshes too") {
    const CheckedDevice device;
    const auto searching = make_search_device(device.shared());
    Progress progress;
    for (const Mesh& mesh : {make_sample("bust", 1500), damaged(Vec3(0)), damaged(Vec3(1e5, -3e6, 4e4))}) {
        const auto solid = mesh_distance(mesh);
        const AdaptiveField field = bake_adaptive(*solid, 28, progress);
        const AdaptiveField on_device = bake_adaptive(*solid, 28, progress, searching.get());
        CHECK(on_device.words == field.words);
        CHECK(on_device.error == field.error);
        const DistanceVolume volume = bake(*solid, 16, progress);
        const DistanceVolume dense_on_device = bake(*solid, 16, progress, searching.get());
        CHECK(dense_on_device.texels == volume.texels);
        CHECK(dense_on_device.error == volume.error);
    }
}

TEST_CASE(
    "a mesh too large for a device is baked without it, as a warning says, and a bake can be cancelled") {
    const CheckedDevice device;
    const auto solid = mesh_distance(make_sample("bust", 800));
    Log log;
    const auto small = make_search_device(device.shared(), {.tree_bytes = 800 * 60, .log = &log});
    CHECK(solid->tracer_with(*small) == nullptr);
    REQUIRE(log.warnings.size() == 1);
    CHECK_THAT(log.warnings.front(),
               Catch::Contains("more triangles than device \"" + device->info().name +
                               "\" bakes (800): its distance field is baked on the CPU"));
    Progress progress;
    CHECK(bake_adaptive(*solid, 24, progress, small.get()).words ==
          bake_adaptive(*solid, 24, progress).words);
    CHECK(log.warnings.size() == 2);
    const auto silent = make_search_device(device.shared(), {.tree_bytes = 800 * 60});
    CHECK(solid->tracer_with(*silent) == nullptr);
    const auto large = make_search_device(device.shared(), {.log = &log});
    CHECK(solid->tracer_with(*large) != nullptr);
    CHECK(log.warnings.size() == 2);
    progress.cancel();
    CHECK_THROWS_AS(bake_adaptive(*solid, 24, progress, large.get()), Cancelled);
    CHECK_THROWS_AS(bake(*solid, 24, progress, large.get()), Cancelled);
}

TEST_CASE("a back end bakes where that is faster, on GPUs, and elsewhere only where it is told to") {
    const CheckedDevice device;
    const bool gpu = device->info().type != DeviceType::cpu;
    const auto bakes = [&](const GpuBackendOptions& options) {
        return make_gpu_backend(device.shared(), options)->search_device() != nullptr;
    };
    CHECK(bakes({}) == gpu);
    CHECK(bakes({.baking = DeviceBaking::always}));
    CHECK_FALSE(bakes({.baking = DeviceBaking::never}));
    CHECK(make_cpu_backend()->search_device() == nullptr);
}

namespace {

/// Finds any triangle.
class Lying final : public SearchDevice {
  public:
    std::unique_ptr<TriangleSearch> put(const NarrowTree& tree) override {
        return std::make_unique<Search>(static_cast<uint32_t>(tree.triangles.size()));
    }

  private:
    class Search final : public TriangleSearch {
      public:
        explicit Search(uint32_t triangles) : triangles_(triangles) {}
        bool find(std::span<const glm::vec3> points, std::span<NearSlots> found) override {
            for (size_t i = 0; i < points.size(); ++i) {
                found[i].fill(kernel::f32::NO_TRIANGLE);
                found[i][0] = static_cast<uint32_t>(i) % triangles_;
            }
            return true;
        }

      private:
        uint32_t triangles_;
    };
};

} // namespace

TEST_CASE("the self-test bakes a field, and finds out a device that bakes another one") {
    const CheckedDevice device;
    const SelftestResult result = run_baking_selftest(*make_search_device(device.shared()));
    CHECK(result.points > 1000);
    CHECK(result.passed());
    Lying lying;
    CHECK_FALSE(run_baking_selftest(lying).passed());
}

// Hidden, since it takes some 6 GiB of memory: anvil_gpu_tests "[ten_million]".
#include "engine/gpu/gpu_backend.h"
#include "tests/gpu/gpu_test.h"

#include <random>

using namespace anvil;

namespace {

constexpr uint32_t side = 3163; // squared: a little over ten million
constexpr size_t handles = 16;

/// phi(t) = 1 - 3 t^2 + 2 t^3
double smooth(double t) {
    return t < 1 ? 1 - t * t * (3 - 2 * t) : 0;
}

/// A grid over the square [-1, 1]^2, with the fans of its triangles.
std::shared_ptr<DeformInput> grid_input() {
    auto input = std::make_shared<DeformInput>();
    input->points.reserve(size_t{side} * side);
    NormalFans& fans = input->fans;
    fans.begin.reserve(size_t{side} * side + 1);
    fans.begin.push_back(0);
    fans.corners.reserve(size_t{4} * side * side);
    for (uint32_t y = 0; y < side; ++y) {
        for (uint32_t x = 0; x < side; ++x) {
            input->points.emplace_back(2.0 * x / (side - 1) - 1, 2.0 * y / (side - 1) - 1, 0);
            const bool inside = x > 0 && y > 0 && x + 1 < side && y + 1 < side;
            const uint32_t at = y * side + x;
            const std::array<uint32_t, 4> around{at + 1, at + side, at - 1, at - side};
            for (size_t i = 0; inside && i < 4; ++i) {
                fans.corners.push_back({around[i], around[(i + 1) % 4]});
            }
            fans.begin.push_back(static_cast<uint32_t>(fans.corners.size()));
        }
    }
    input->handle_count = handles;
    input->segments = {{0, 1, 0, -3, 2}};
    input->shapes.assign(handles, {0, 1});
    input->fields.reserve(handles * side * side);
    for (size_t j = 0; j < handles; ++j) {
        const Vec3 handle(0.45 * static_cast<double>(j % 4) - 0.7, 0.45 * static_cast<double>(j / 4) - 0.7,
                          0);
        for (const Vec3& p : input->points) {
            input->fields.push_back(glm::length(p - handle) / 0.6);
        }
    }
    return input;
}

} // namespace

TEST_CASE("ten million vertices follow sixteen handles, with their normals", "[.ten_million]") {
    const auto device = std::make_shared<Device>();
    const auto backend = make_gpu_backend(device);
    const std::shared_ptr<DeformInput> input = grid_input();
    const size_t n = input->points.size();
    DeformMotion motion;
    double total = 0;
    for (size_t j = 0; j < handles; ++j) {
        motion.targets.emplace_back(0.02, -0.01 * static_cast<double>(j % 3), j % 2 == 0 ? 0.2 : -0.1);
        total += glm::length(motion.targets.back());
    }
    const auto session = backend->prepare(input);
    session->update(motion);
    const std::vector<PointResult> results = session->download();
    REQUIRE(results.size() == n);
    std::vector<Vec3> ends(n);
    double worst = 0;
    for (size_t i = 0; i < n; ++i) {
        Vec3 sum(0);
        for (size_t j = 0; j < handles; ++j) {
            sum += smooth(input->fields[j * n + i]) * motion.targets[j];
        }
        ends[i] = input->points[i] + sum;
        if (!(glm::length(results[i].displacement - sum) <= worst)) { // what is not finite too
            worst = glm::length(results[i].displacement - sum);
        }
    }
    // Each weight is off by the rounding of its distance, of its own and of its cubic's terms, which reach 6.
    CHECK(worst <= total * 16 * std::ldexp(1.0, -24));

    const std::vector<Vec3> normals = session->download_normals();
    REQUIRE(normals.size() == n);
    double tilt = 0;
    for (size_t i = 0; i < n; ++i) {
        Vec3 sum(0);
        for (uint32_t f = input->fans.begin[i]; f < input->fans.begin[i + 1]; ++f) {
            const auto& corner = input->fans.corners[f];
            sum += glm::cross(ends[corner.b] - ends[i], ends[corner.c] - ends[i]);
        }
        const double size = glm::length(sum);
        const double off = size > 0 ? glm::length(normals[i] - sum / size) : glm::length(normals[i]);
        tilt = off <= tilt ? tilt : off;
    }
    // Edges are 6e-4 long: the rounding of their ends, 2^-24 of places up to 1.4, twice, tilts them by some
    // 3e-4.
    CHECK(tilt <= 1e-3);
    WARN(n << " vertices, worst " << worst << ", normals " << tilt << ", " << (device->memory_in_use() >> 20)
           << " MiB of the device's memory");
}

#include "engine/distance/smoothed_surface.h"
#include "tests/unit/distance/surfaces.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::surfaces;

namespace {

constexpr int cells = 60;
const uint32_t middle = cells / 2 * (cells + 1) + cells / 2;

/// Rises of 1.5 `sigma` cells and some five `sigma` across, at random places of the unit square.
Mesh with_rises(const Mesh& flat, double sigma) {
    Mesh mesh = flat;
    std::mt19937 random(3);
    const auto uniform = [&] { return random() / 4294967296.0; };
    for (int k = 0; k < 30; ++k) {
        const double x = uniform();
        const Vec3 centre(x, uniform(), 0);
        for (size_t v = 0; v < mesh.positions.size(); ++v) {
            const double d = glm::length(flat.positions[v] - centre) * cells / sigma;
            mesh.positions[v].z += 1.5 * sigma / cells * std::exp(-0.5 * d * d);
        }
    }
    return mesh;
}

/// How far the exact distances from the middle are from those on the flat square, at most and relatively,
/// between 0.1 and 0.45.
double unroundness(const Mesh& mesh, const Mesh& flat, uint32_t rounds) {
    const Mesh smooth = from_triangles(smoothed_positions(mesh, mesh.positions, rounds), mesh.triangles);
    const SurfacePoint source = vertex_source(middle);
    const std::vector<double> found = solve(smooth, {source}, infinity, DistanceMethod::exact);
    const std::vector<double> expected = straight(flat, {source});
    double worst = 0;
    for (size_t v = 0; v < found.size(); ++v) {
        if (expected[v] > 0.1 && expected[v] < 0.45) {
            worst = std::max(worst, std::abs(found[v] / expected[v] - 1));
        }
    }
    return worst;
}

double farthest_move(const Mesh& mesh, const std::vector<Vec3>& moved) {
    double worst = 0;
    for (size_t v = 0; v < moved.size(); ++v) {
        const double move = glm::length(moved[v] - mesh.positions[v]);
        worst = move >= worst ? move : worst;
        REQUIRE(is_finite(moved[v]));
    }
    return worst;
}

} // namespace

TEST_CASE("flat parts stay as they are, however irregular their triangles") {
    const Mesh mesh = plane(30, 30, 1, 1, 0.4);
    for (const uint32_t rounds : {0U, 1U, 2U, 7U, 40U}) {
        CHECK(farthest_move(mesh, smoothed_positions(mesh, mesh.positions, rounds)) < 1e-14);
    }
}

TEST_CASE("on a smoothed copy distances no longer know of bumps: circles become round again") {
    const Mesh flat = plane(cells, cells, 1, 1, 0.2);
    // Measured: 9.1 to 0.5 % with bumps of five cells, 20 to 1.6 % with bumps of ten.
    const Mesh small = with_rises(flat, 1), wide = with_rises(flat, 2);
    CHECK(unroundness(small, flat, 0) > 0.07);
    CHECK(unroundness(small, flat, 20) < 0.008);
    CHECK(unroundness(wide, flat, 0) > 0.15);
    CHECK(unroundness(wide, flat, 40) < 0.025);
    Mesh spiked = flat;
    spiked.positions[middle + 10].z = 8.0 / cells;
    CHECK(unroundness(spiked, flat, 0) > 0.3);
    CHECK(unroundness(spiked, flat, 20) < 0.03);
}

TEST_CASE("what is large and smooth keeps its size") {
    for (const uint32_t rounds : {1U, 5U, 20U}) {
        const Mesh mesh = sphere(4);
        // A circumference of some 40 edges; a plain average shrinks it by 20 % in 20 rounds.
        CHECK(farthest_move(mesh, smoothed_positions(mesh, mesh.positions, rounds)) < 0.003);
    }
}

TEST_CASE("boundaries, edges with three triangles and vertices without any stay where they are") {
    Mesh rough = three_sheets(6).mesh;
    rough.positions.emplace_back(9, 9, 9);
    std::mt19937 random(2);
    for (Vec3& p : rough.positions) {
        p += 0.3 * Vec3(random() / 4294967296.0, random() / 4294967296.0, random() / 4294967296.0);
    }
    const std::vector<Vec3> smooth = smoothed_positions(rough, rough.positions, 15);
    const Sheets sheets = three_sheets(6);
    size_t moved = 0;
    for (int sheet = 0; sheet < 3; ++sheet) {
        for (int i = 0; i <= 6; ++i) {
            for (int j = 0; j <= 6; ++j) {
                const uint32_t v = sheets.index(sheet, i, j);
                const bool inner = i > 0 && i < 6 && j > 0 && j < 6;
                CHECK((inner || smooth[v] == rough.positions[v]));
                moved += inner && smooth[v] != rough.positions[v] ? 1 : 0;
            }
        }
    }
    CHECK(moved == 75);
    CHECK(smooth.back() == rough.positions.back());
}

TEST_CASE("faces without area and vertices named twice are smoothed without a fault") {
    Mesh mesh = bumps(8, 0.2);
    mesh.triangles.push_back({3, 3, 12});
    mesh.triangles.push_back({5, 5, 5});
    mesh.positions[40] = mesh.positions[41];
    mesh = from_triangles(mesh.positions, mesh.triangles);
    CHECK(farthest_move(mesh, smoothed_positions(mesh, mesh.positions, 30)) < 1);
}

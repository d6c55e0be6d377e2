#include "engine/core/error.h"
#include "tests/unit/distance/surfaces.h"

#include <catch2/catch.hpp>
#include <thread>

using namespace anvil;
using namespace anvil::surfaces;

namespace {

// Fronts march in float: each update adds a few roundings of 6e-8, and a gain below 1e-5 that no longer moves
// the front is not taken.
constexpr double float_roundings = 1.2e-5;

Mesh with_positions(Mesh mesh, double scale, const Vec3& offset) {
    for (Vec3& p : mesh.positions) {
        p = p * scale + offset;
    }
    return mesh;
}

} // namespace

TEST_CASE("geodesic distances in a plane are the straight ones, from vertices, edges and faces") {
    const Mesh mesh = plane(24, 17, 1.3, 1.0, 0.25);
    const uint32_t centre = 8 * 25 + 12;
    const std::vector<SurfacePoint> sources = {vertex_source(centre),
                                               vertex_source(0),
                                               {200, {0.2, 0.3, 0.5}, no_index},
                                               {333, {0.4, 0, 0.6}, no_index},
                                               {150, {0, 0.1, 0.9}, no_index},
                                               {150, {0, 1, 0}, no_index}};
    for (const SurfacePoint& source : sources) {
        CHECK(worst_relative(solve(mesh, {source}), straight(mesh, {source}), 0.01) < float_roundings);
    }
}

TEST_CASE("several sources give the minimum of the single ones in a plane") {
    const Mesh mesh = plane(30, 30, 1, 1, 0.25, 3);
    const std::vector<SurfacePoint> sources = {
        vertex_source(100), {900, {0.1, 0.6, 0.3}, no_index}, vertex_source(700)};
    const std::vector<double> expected = straight(mesh, sources);
    const std::vector<double> found = solve(mesh, sources);
    CHECK(worst_relative(found, expected, 0.01) < float_roundings);
}

TEST_CASE("a folded strip has the distances of the flat one") {
    const int columns = 40, rows = 8;
    const Mesh flat = plane(columns, rows, 40, 8, 0);
    const Mesh folded = folded_strip(flat, columns);
    const std::vector<SurfacePoint> source = {{37, {0.3, 0.3, 0.4}, no_index}};
    CHECK(worst_relative(solve(folded, source), solve(flat, source), 1) < float_roundings);
    CHECK(worst_relative(solve(flat, source), straight(flat, source), 1) < float_roundings);
}

TEST_CASE("distances on a prism are those of its unrolled sides") {
    const int columns = 32, rows = 12;
    const double side = 2 * std::sin(M_PI / columns);
    const Mesh mesh = prism(columns, rows, 2);
    const uint32_t source = 5 * (columns + 1) + 3;
    const std::vector<double> found = solve(mesh, {vertex_source(source)});
    double worst = 0;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const int across = std::abs(i - 3);
            const double expected =
                std::hypot(std::min(across, columns - across) * side, 2.0 * (j - 5) / rows);
            const double error = std::abs(found[j * (columns + 1) + i] - expected) / std::max(expected, side);
            // At the far side two fronts of one source meet, where an approximate method may err.
            worst = std::max(worst, across == columns / 2 ? error / 1e8 : error);
        }
    }
    CHECK(worst < float_roundings);
}

TEST_CASE("distances on finer and finer spheres converge to the angle") {
    double last = infinity;
    for (int times = 2; times <= 5; ++times) {
        const Mesh mesh = sphere(times);
        const std::vector<double> found = solve(mesh, {vertex_source(0)});
        double sum = 0;
        for (size_t v = 0; v < found.size(); ++v) {
            const double angle =
                std::acos(std::clamp(glm::dot(mesh.positions[v], mesh.positions[0]), -1.0, 1.0));
            REQUIRE(std::isfinite(found[v]));
            sum += std::abs(found[v] - angle);
        }
        const double mean = sum / static_cast<double>(found.size());
        CHECK(mean < 0.7 * last);
        last = mean;
    }
    CHECK(last < 5e-3);
}

TEST_CASE("within the radius a bounded run gives the numbers of the unbounded one, and nothing beyond") {
    const Mesh mesh = sphere(4);
    const std::vector<SurfacePoint> sources = {vertex_source(17), {77, {0.2, 0.2, 0.6}, no_index}};
    const std::vector<double> all = solve(mesh, sources);
    for (const double radius : {0.0, 0.03, 0.3, 1.0, 2.5, 10.0}) {
        const std::vector<double> some = solve(mesh, sources, radius);
        size_t different = 0;
        for (size_t v = 0; v < all.size(); ++v) {
            different += some[v] != (all[v] <= radius ? all[v] : infinity) ? 1 : 0;
        }
        CHECK(different == 0);
    }
}

TEST_CASE("a second run on the same solver repeats the first, also from many threads") {
    const Mesh mesh = sphere(3);
    const GeodesicSolver solver(mesh, mesh.positions);
    const std::vector<SurfacePoint> one = {vertex_source(5)}, other = {vertex_source(300)};
    const std::vector<double> first = solver.solve(one).dense(mesh.vertex_count());
    solver.solve(other, 0.4);
    std::array<std::vector<double>, 4> again;
    std::vector<std::thread> threads;
    for (std::vector<double>& result : again) {
        threads.emplace_back([&] { result = solver.solve(one).dense(mesh.vertex_count()); });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    for (const std::vector<double>& result : again) {
        CHECK(result == first);
    }
}

TEST_CASE("what no path reaches stays infinite, isolated vertices included") {
    Mesh mesh = plane(3, 3, 1, 1, 0);
    const auto first = static_cast<uint32_t>(mesh.vertex_count());
    mesh.positions.insert(mesh.positions.end(), {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {0.5, 0.5, 0}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.add_polygon(mesh.triangles.back());
    const std::vector<double> found = solve(mesh, {vertex_source(0)});
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        CHECK(std::isinf(found[v]) == (v >= first));
    }
    const std::vector<double> alone = solve(mesh, {vertex_source(first + 3)});
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        CHECK(alone[v] == (v == first + 3 ? 0.0 : infinity));
    }
    CHECK(solve(mesh, {})[0] == infinity);
}

TEST_CASE("three sheets on one edge are each reached as the flat pair that they form") {
    const int n = 8;
    const Sheets sheets = three_sheets(n);
    const std::vector<double> found = solve(sheets.mesh, {vertex_source(sheets.index(0, 3, 4))});
    double worst = 0;
    for (int sheet = 0; sheet < 3; ++sheet) {
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; j <= n; ++j) {
                const double expected = std::hypot(sheet == 0 ? i - 3 : i + 3, j - 4);
                worst = std::max(worst, std::abs(found[sheets.index(sheet, i, j)] - expected));
            }
        }
    }
    // Vertices on the shared edge are sources of their own: paths through them are a little too long.
    CHECK(worst < 0.3);
}

TEST_CASE("faces without area are crossed, and do not disturb the others") {
    Mesh mesh = plane(6, 6, 6, 6, 0);
    const auto middle = static_cast<uint32_t>(mesh.vertex_count());
    mesh.positions.push_back(mesh.positions[24]); // a second vertex in the same place
    mesh.positions.emplace_back(9, 0, 0);         // reached through a flattened triangle only
    mesh.triangles.push_back({24, middle, 25});   // needle without area
    mesh.triangles.push_back({6, middle + 1, 5}); // three points on a line
    mesh.triangles.push_back({10, 10, 11});       // a corner twice
    const std::vector<double> found = solve(mesh, {vertex_source(24)});
    CHECK(found[middle] == 0);
    CHECK(found[6] == Approx(std::sqrt(18.0)).epsilon(float_roundings));
    CHECK(found[middle + 1] == Approx(std::sqrt(18.0) + 3).epsilon(float_roundings));
    for (uint32_t v = 0; v < 49; ++v) {
        const double expected = glm::length(mesh.positions[v] - mesh.positions[24]);
        CHECK(found[v] == Approx(expected).epsilon(0.03));
    }
}

TEST_CASE("scaling by a power of two scales the distances bit for bit, at any size") {
    const Mesh mesh = sphere(3);
    const std::vector<SurfacePoint> sources = {{77, {0.2, 0.2, 0.6}, no_index}};
    const std::vector<double> expected = solve(mesh, sources, 1.5);
    for (const int exponent : {-340, -100, -1, 7, 100, 500}) {
        const double scale = std::ldexp(1.0, exponent);
        const std::vector<double> found = solve(with_positions(mesh, scale, Vec3(0)), sources, 1.5 * scale);
        size_t different = 0;
        for (size_t v = 0; v < found.size(); ++v) {
            different += found[v] != expected[v] * scale ? 1 : 0;
        }
        CHECK(different == 0);
    }
}

TEST_CASE("a surface far from the origin keeps its distances to the rounding of its positions") {
    const Mesh mesh = sphere(3);
    const std::vector<SurfacePoint> sources = {vertex_source(3)};
    const std::vector<double> found = solve(with_positions(mesh, 1, {1e6, -3e5, 2e6}), sources);
    CHECK(worst_relative(found, solve(mesh, sources), 0.1) < float_roundings);
}

TEST_CASE("euclidean distances are the straight ones, bounded by the radius") {
    const std::vector<Vec3> positions = {{0, 0, 0}, {3, 4, 0}, {1, 0, 0}, {1e200, 0, 0}};
    const std::vector<Vec3> sources = {{0, 0, 0}, {3, 0, 0}};
    const std::vector<double> found = euclidean_distances(positions, sources).dense(4);
    CHECK(found == std::vector<double>{0, 4, 1, 1e200});
    const DistanceField bounded = euclidean_distances(positions, sources, {}, 1);
    CHECK(bounded.vertices == std::vector<uint32_t>{0, 2});
    CHECK(euclidean_distances(positions, {}).vertices.empty());
}

TEST_CASE("sources and radii that cannot be meant are named") {
    const Mesh mesh = plane(2, 2, 1, 1, 0);
    const GeodesicSolver solver(mesh, mesh.positions);
    const auto from = [&](SurfacePoint point, double radius = 1.0) {
        const std::vector<SurfacePoint> sources = {point};
        return solver.solve(sources, radius);
    };
    CHECK_THROWS_AS(from(vertex_source(9)), InputError);
    CHECK_THROWS_AS(from({8, {1, 0, 0}, no_index}), InputError);
    CHECK_THROWS_AS(from({0, {0.5, 0.6, 0}, no_index}), InputError);
    CHECK_THROWS_AS(from({0, {-0.5, 0.5, 1}, no_index}), InputError);
    CHECK_THROWS_AS(from({0, {NAN, 0.5, 0.5}, no_index}), InputError);
    CHECK_THROWS_AS(from(vertex_source(0), NAN), InputError);
    CHECK_THROWS_AS(from(vertex_source(0), -1), InputError);
    CHECK_THROWS_AS(GeodesicSolver(mesh, std::span(mesh.positions).first(3)), InputError);
}

#include "tests/unit/distance/surfaces.h"

#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <fstream>

using namespace anvil;
using namespace anvil::surfaces;

namespace {

constexpr DistanceMethod exact = DistanceMethod::exact;

// Every window is laid out anew in each triangle that it crosses: some 100 times a few eps.
constexpr double roundings = 1e-12;

} // namespace

TEST_CASE("exact distances in a plane are the straight ones from any number of sources of any kind") {
    const Mesh mesh = plane(24, 17, 1.3, 1.0, 0.25);
    const std::vector<SurfacePoint> sources = {
        vertex_source(8 * 25 + 12),       vertex_source(0),
        {200, {0.2, 0.3, 0.5}, no_index}, {333, {0.4, 0, 0.6}, no_index},
        {150, {0, 0.1, 0.9}, no_index},   {150, {0, 1, 0}, no_index}};
    for (const SurfacePoint& source : sources) {
        CHECK(worst_relative(solve(mesh, {source}, infinity, exact), straight(mesh, {source}), 0.01) <
              roundings);
    }
    CHECK(worst_relative(solve(mesh, sources, infinity, exact), straight(mesh, sources), 0.01) < roundings);
}

TEST_CASE("exact distances on a folded strip are those of the flat one") {
    const Mesh flat = plane(40, 8, 40, 8, 0);
    const std::vector<SurfacePoint> source = {{37, {0.3, 0.3, 0.4}, no_index}};
    CHECK(worst_relative(solve(folded_strip(flat, 40), source, infinity, exact), straight(flat, source), 1) <
          roundings);
}

TEST_CASE("exact distances on a prism are the shorter way around its unrolled sides") {
    const int columns = 32, rows = 12;
    const double side = 2 * std::sin(M_PI / columns);
    const std::vector<double> found =
        solve(prism(columns, rows, 2), {vertex_source(5 * (columns + 1) + 3)}, infinity, exact);
    double worst = 0;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const int across = std::min(std::abs(i - 3), columns - std::abs(i - 3));
            const double expected = std::hypot(across * side, 2.0 * (j - 5) / rows);
            worst = std::max(worst, std::abs(found[j * (columns + 1) + i] - expected));
        }
    }
    CHECK(worst < roundings);
}

TEST_CASE("exact paths on a cone pass beside the apex, never over it") {
    // A cone of n flat sectors with apex angle a each: unrolled, a path spans at most half the total angle.
    const int n = 14;
    const double sector = 0.35;
    const double radius = std::sin(sector / 2) / std::sin(M_PI / n);
    std::vector<Vec3> positions = {{0, 0, std::sqrt(1 - radius * radius)}};
    std::vector<Triangle> triangles;
    for (int i = 0; i < n; ++i) {
        positions.emplace_back(radius * std::cos(2 * M_PI * i / n), radius * std::sin(2 * M_PI * i / n), 0);
        triangles.push_back({0, static_cast<uint32_t>(1 + i), static_cast<uint32_t>(1 + (i + 1) % n)});
    }
    const std::vector<double> found =
        solve(from_triangles(positions, triangles), {vertex_source(1)}, infinity, exact);
    for (int i = 0; i < n; ++i) {
        const double angle = sector * std::min(i, n - i);
        CHECK(found[1 + i] == Approx(2 * std::sin(angle / 2)).margin(roundings));
    }
    CHECK(found[0] == Approx(1).epsilon(roundings));
}

TEST_CASE("exact distances on a flat torus of unfolded squares take the nearest image") {
    // Lengths alone count, so a torus that is flat in itself is built as a folded (in space degenerate)
    // prism: rows go up and down again between two levels.
    const int columns = 12, rows = 8;
    Mesh mesh = prism(columns, rows, rows);
    const auto at = [&](int i, int j) {
        return static_cast<uint32_t>((j % rows) * (columns + 1) + i % columns);
    };
    std::vector<Triangle> triangles;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            mesh.positions[at(i, j)].y = std::min(j, rows - j);
            triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    mesh = from_triangles(mesh.positions, triangles);
    const double side = 2 * std::sin(M_PI / columns);
    const std::vector<double> found = solve(mesh, {vertex_source(at(2, 3))}, infinity, exact);
    double worst = 0;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const int di = std::abs(i - 2), dj = std::abs(j - 3);
            const double expected = std::hypot(std::min(di, columns - di) * side, std::min(dj, rows - dj));
            worst = std::max(worst, std::abs(found[at(i, j)] - expected));
        }
    }
    CHECK(worst < 10 * roundings);
}

TEST_CASE("exact distances cross an edge of three sheets as if any two were flat") {
    const int n = 8;
    const Sheets sheets = three_sheets(n);
    const std::vector<double> found =
        solve(sheets.mesh, {vertex_source(sheets.index(0, 3, 4))}, infinity, exact);
    double worst = 0;
    for (int sheet = 0; sheet < 3; ++sheet) {
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; j <= n; ++j) {
                const double expected = std::hypot(sheet == 0 ? i - 3 : i + 3, j - 4);
                worst = std::max(worst, std::abs(found[sheets.index(sheet, i, j)] - expected));
            }
        }
    }
    CHECK(worst < 10 * roundings);
}

TEST_CASE("exact distances are symmetric, keep the triangle inequality and do not depend on the numbering") {
    const Mesh mesh = bumps(14, 0.2);
    const auto n = static_cast<uint32_t>(mesh.vertex_count());
    const GeodesicSolver solver(mesh, mesh.positions);
    std::vector<std::vector<double>> all;
    for (uint32_t v = 0; v < n; v += 16) {
        const std::vector<SurfacePoint> source = {vertex_source(v)};
        all.push_back(solver.solve(source, infinity, exact).dense(n));
    }
    double asymmetry = 0, violation = 0;
    for (size_t a = 0; a < all.size(); ++a) {
        for (size_t b = 0; b < all.size(); ++b) {
            asymmetry = std::max(asymmetry, std::abs(all[a][16 * b] - all[b][16 * a]));
            for (uint32_t v = 0; v < n; ++v) {
                violation = std::max(violation, all[a][v] - all[a][16 * b] - all[b][v]);
            }
        }
    }
    CHECK(asymmetry < roundings);
    CHECK(violation < roundings);

    std::vector<Vec3> positions(n);
    const auto renumbered = [&](uint32_t v) { return (v * 97 + 31) % n; };
    for (uint32_t v = 0; v < n; ++v) {
        positions[renumbered(v)] = mesh.positions[v];
    }
    std::vector<Triangle> triangles;
    for (const Triangle& t : mesh.triangles) {
        triangles.insert(triangles.begin(), {renumbered(t[1]), renumbered(t[2]), renumbered(t[0])});
    }
    REQUIRE(std::gcd(97U, n) == 1);
    const std::vector<double> other =
        solve(from_triangles(positions, triangles), {vertex_source(renumbered(16))}, infinity, exact);
    double worst = 0;
    for (uint32_t v = 0; v < n; ++v) {
        worst = std::max(worst, std::abs(other[renumbered(v)] - all[1][v]));
    }
    CHECK(worst < roundings);
}

TEST_CASE("an exact run within a radius gives the numbers of the unbounded one, and nothing beyond") {
    const Mesh mesh = bumps(30, 0.2);
    const std::vector<SurfacePoint> sources = {vertex_source(100), {777, {0.2, 0.2, 0.6}, no_index}};
    const std::vector<double> all = solve(mesh, sources, infinity, exact);
    for (const double radius : {0.0, 0.05, 0.2, 0.6, 5.0}) {
        const std::vector<double> some = solve(mesh, sources, radius, exact);
        size_t different = 0;
        for (size_t v = 0; v < all.size(); ++v) {
            different += some[v] != (all[v] <= radius ? all[v] : infinity) ? 1 : 0;
        }
        CHECK(different == 0);
    }
}

TEST_CASE("approximate distances stay within a few tenths of a per cent of the exact ones") {
    for (const double height : {0.05, 0.2}) {
        const Mesh mesh = bumps(60, height);
        for (const uint32_t source : {0U, 1860U, 2500U}) {
            const std::vector<double> truth = solve(mesh, {vertex_source(source)}, infinity, exact);
            const std::vector<double> found = solve(mesh, {vertex_source(source)});
            double sum = 0, worst = 0;
            for (size_t v = 0; v < truth.size(); ++v) {
                const double error = truth[v] > 1.0 / 60 ? std::abs(found[v] - truth[v]) / truth[v] : 0;
                sum += error;
                worst = std::max(worst, error);
            }
            // The aims of the method: 0.08 % on average, 1 % at most; twice that at the worst on this coarse
            // grid.
            CHECK(sum / static_cast<double>(truth.size()) < 8e-4);
            CHECK(worst < 0.02);
        }
    }
}

TEST_CASE("auto is exact for small regions and for non-manifold ones, and says so") {
    const Mesh large = bumps(90, 0.1);
    const GeodesicSolver solver(large, large.positions);
    const std::vector<SurfacePoint> source = {vertex_source(4000)};
    CHECK(solver.solve(source).method == DistanceMethod::approximate);
    const DistanceField near = solver.solve(source, 0.1);
    CHECK(near.method == DistanceMethod::exact);
    CHECK(near.dense(large.vertex_count()) == solver.solve(source, 0.1, exact).dense(large.vertex_count()));
    const Sheets sheets = three_sheets(60);
    const GeodesicSolver fins(sheets.mesh, sheets.mesh.positions);
    CHECK(fins.solve(source).method == DistanceMethod::exact);
}

TEST_CASE("distances on scanned and designed meshes agree with those of other exact solvers") {
    const char* folder = std::getenv("ANVIL_TEST_EXACT");
    if (folder == nullptr) {
        return;
    }
    for (const char* name : {"hand", "fandisk", "wingnut", "rob_human"}) {
        INFO(name);
        const std::string base = std::string(folder) + "/" + name;
        Mesh mesh;
        std::ifstream file(base + ".obj");
        std::string keyword;
        while (file >> keyword) {
            if (keyword == "v") {
                Vec3 p;
                file >> p.x >> p.y >> p.z;
                mesh.positions.push_back(p);
            } else if (keyword == "f") {
                Triangle t;
                file >> t[0] >> t[1] >> t[2];
                mesh.triangles.push_back({t[0] - 1, t[1] - 1, t[2] - 1});
            }
        }
        REQUIRE(!mesh.triangles.empty());
        const GeodesicSolver solver(mesh, mesh.positions);
        std::ifstream sources(base + ".src");
        uint32_t v = 0;
        while (sources >> v) {
            std::vector<double> truth(mesh.vertex_count());
            std::ifstream values(base + "_" + std::to_string(v) + ".f64", std::ios::binary);
            REQUIRE(values.read(reinterpret_cast<char*>(truth.data()),
                                static_cast<std::streamsize>(8 * truth.size())));
            for (double& d : truth) {
                d = d > 1e50 ? infinity : d;
            }
            const std::vector<SurfacePoint> source = {vertex_source(v)};
            CHECK(worst_relative(solver.solve(source, infinity, exact).dense(truth.size()), truth, 1e-6) <
                  1e-10);
            const std::vector<double> near =
                solver.solve(source, infinity, DistanceMethod::approximate).dense(truth.size());
            double sum = 0;
            for (size_t i = 0; i < truth.size(); ++i) {
                sum += std::isfinite(truth[i]) && truth[i] > 0 ? std::abs(near[i] - truth[i]) / truth[i] : 0;
            }
            CHECK(sum / static_cast<double>(truth.size()) < 1.2e-3);
        }
    }
}

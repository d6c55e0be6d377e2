// Exact distances where faces meet in any number and way, against graphs that know nothing of windows.
#include "tests/unit/distance/steiner_graph.h"
#include "tests/unit/distance/surfaces.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::surfaces;

namespace {

constexpr DistanceMethod exact = DistanceMethod::exact;
constexpr double roundings = 1e-12;

/// Sheets of 2 x 3 cells, each crumpled, on one common spine.
Mesh book(int pages) {
    std::mt19937 random(7);
    const auto uniform = [&] { return random() / 4294967296.0 - 0.5; };
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    for (int j = 0; j <= 3; ++j) {
        positions.emplace_back(0.1 * uniform(), j, 0.1 * uniform());
    }
    for (int page = 0; page < pages; ++page) {
        const auto at = [&](int i, int j) {
            return static_cast<uint32_t>(i == 0 ? j : 4 + (2 * page + i - 1) * 4 + j);
        };
        const double angle = 2 * M_PI * page / pages;
        for (int i = 1; i <= 2; ++i) {
            for (int j = 0; j <= 3; ++j) {
                positions.emplace_back(i * std::cos(angle) + 0.5 * uniform(), j + 0.5 * uniform(),
                                       i * std::sin(angle) + 0.5 * uniform());
            }
        }
        for (int i = 0; i < 2; ++i) {
            for (int j = 0; j < 3; ++j) {
                // Every other page the wrong way around.
                Triangle one = {at(i, j), at(i + 1, j), at(i + 1, j + 1)};
                Triangle two = {at(i, j), at(i + 1, j + 1), at(i, j + 1)};
                if (page % 2 == 1) {
                    std::swap(one[0], one[1]);
                    std::swap(two[0], two[1]);
                }
                triangles.push_back(one);
                triangles.push_back(two);
            }
        }
    }
    return from_triangles(std::move(positions), std::move(triangles));
}

/// Two crumpled discs and a closed tetrahedron that have only vertex 0 in common.
Mesh bow_tie() {
    std::mt19937 random(9);
    const auto uniform = [&] { return random() / 4294967296.0 - 0.5; };
    std::vector<Vec3> positions = {Vec3(0)};
    std::vector<Triangle> triangles;
    for (const double side : {-1.0, 1.0}) {
        const auto first = static_cast<uint32_t>(positions.size());
        for (uint32_t i = 0; i < 12; ++i) {
            const double angle = 2 * M_PI * (i % 6) / 6, radius = i < 6 ? 1 : 2;
            positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                   side * (radius + uniform()));
            const uint32_t next = (i + 1) % 6;
            if (i < 6) {
                triangles.push_back({0, first + i, first + next});
                triangles.push_back({first + i, first + 6 + i, first + 6 + next});
                triangles.push_back({first + i, first + 6 + next, first + next});
            }
        }
    }
    const auto top = static_cast<uint32_t>(positions.size());
    positions.insert(positions.end(), {{3, 0.2, 0}, {3, -0.8, 0.5}, {3, -0.4, -0.6}});
    triangles.insert(triangles.end(),
                     {{0, top, top + 1}, {0, top + 1, top + 2}, {0, top + 2, top}, {top, top + 1, top + 2}});
    return from_triangles(std::move(positions), std::move(triangles));
}

/// A strip with half a turn: no orientation fits all of it.
Mesh moebius() {
    const uint32_t n = 9;
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    for (uint32_t i = 0; i < n; ++i) {
        const double angle = 2 * M_PI * i / n;
        for (const double r : {-0.4, 0.0, 0.4}) {
            const double radius = 1 + r * std::cos(angle / 2);
            positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                   r * std::sin(angle / 2));
        }
        for (uint32_t k = 0; k < 2; ++k) {
            const bool last = i + 1 == n;
            const uint32_t a = 3 * i + k, b = a + 1;
            const uint32_t c = last ? 2 - k : a + 3, d = last ? 1 - k : b + 3;
            triangles.push_back({a, c, d});
            triangles.push_back({a, d, b});
        }
    }
    return from_triangles(std::move(positions), std::move(triangles));
}

/// A bumpy sheet with a fin along an inner row.
Mesh finned() {
    Mesh mesh = bumps(5, 0.15);
    const auto count = static_cast<uint32_t>(mesh.vertex_count());
    for (uint32_t i = 0; i < 5; ++i) {
        mesh.positions.push_back(mesh.positions[18 + i] + Vec3(0.02, 0.03, 0.2));
        mesh.triangles.push_back({18 + i, 19 + i, count + i});
        if (i > 0) {
            mesh.triangles.push_back({18 + i, count + i, count + i - 1}); // wrong way around on purpose
        }
    }
    return mesh;
}

/// Two spheres that share the faces of a cap, twice over: faces on faces, each edge of them with four.
Mesh doubled_cap() {
    Mesh mesh = sphere(1);
    const size_t count = mesh.triangles.size();
    for (size_t f = 0; f < count; f += 3) {
        mesh.triangles.push_back(mesh.triangles[f]);
    }
    return mesh;
}

} // namespace

TEST_CASE("exact distances lie between graphs of points and graphs of pieces on any non-manifold surface, "
          "which close in on them") {
    struct Named {
        const char* name;
        Mesh mesh;
    };
    const std::vector<Named> surfaces = {
        {"book of three pages", book(3)}, {"fan of five", book(5)}, {"bow-tie", bow_tie()},
        {"Moebius strip", moebius()},     {"fin", finned()},        {"doubled faces", doubled_cap()}};
    for (const Named& surface : surfaces) {
        const auto n = static_cast<uint32_t>(surface.mesh.vertex_count());
        for (const uint32_t source : {0U, n / 2, n - 1}) {
            INFO(surface.name << " from " << source);
            const std::vector<double> found = solve(surface.mesh, {vertex_source(source)}, infinity, exact);
            double last = infinity;
            for (const int pieces : {3, 10, 36}) {
                const std::vector<double> above = graph_distances(surface.mesh, source, pieces, false);
                const std::vector<double> below = graph_distances(surface.mesh, source, pieces, true);
                double worst_above = -infinity, worst_below = -infinity, gap = 0, excess = 0;
                for (uint32_t v = 0; v < n; ++v) {
                    REQUIRE(std::isfinite(found[v]));
                    worst_above = std::max(worst_above, found[v] - above[v]);
                    worst_below = std::max(worst_below, below[v] - found[v]);
                    gap = std::max(gap, above[v] - below[v]);
                    excess = std::max(excess, above[v] / found[v] - 1);
                }
                CHECK(worst_above < roundings);
                CHECK(worst_below < roundings);
                // Each crossing of an edge leaves at most a piece open to the bounds, of a quarter the
                // length.
                CHECK(gap < 0.5 * last);
                last = gap;
                // A line moved by up to 1/74 of an edge wherever it crosses one.
                CHECK((pieces < 36 || excess < 1.5e-3));
            }
        }
    }
}

TEST_CASE("exact distances in a plane stay straight over needles, caps and faces without area") {
    // Columns a billionth wide between ordinary ones.
    const Mesh even = plane(16, 9, 16, 1, 0);
    Mesh needles = even;
    for (Vec3& p : needles.positions) {
        const int column = static_cast<int>(std::lround(p.x));
        p.x = column / 2 * 0.125 + column % 2 * 1e-9;
    }
    // A face without area on one side of every triangle: its middle, on the side itself.
    Mesh caps = plane(7, 7, 1, 1, 0.2);
    std::vector<Triangle> triangles;
    for (const Triangle& t : caps.triangles) {
        const auto middle = static_cast<uint32_t>(caps.vertex_count());
        caps.positions.push_back(0.5 * (caps.positions[t[0]] + caps.positions[t[1]]));
        triangles.insert(triangles.end(), {{t[0], middle, t[2]}, {middle, t[1], t[2]}, {t[0], t[1], middle}});
    }
    caps = from_triangles(caps.positions, triangles);
    for (const Mesh& mesh : {needles, caps}) {
        const auto n = static_cast<uint32_t>(mesh.vertex_count());
        for (const uint32_t source : {0U, 40U, n - 1}) {
            const std::vector<double> found = solve(mesh, {vertex_source(source)}, infinity, exact);
            double worst = 0;
            for (uint32_t v = 0; v < n; ++v) {
                const double error =
                    std::abs(found[v] - glm::length(mesh.positions[v] - mesh.positions[source]));
                worst = error >= 0 ? std::max(worst, error) : infinity;
            }
            CHECK(worst < roundings);
        }
    }
}

TEST_CASE("exact distances lie between their bounds on random triangles of a few points, whatever becomes of "
          "their area") {
    std::mt19937 random(3);
    for (int round = 0; round < 40; ++round) {
        std::vector<Vec3> positions;
        for (int v = 0; v < 14; ++v) {
            positions.emplace_back(random() % 4, random() % 3, random() % 2); // some coincide
        }
        std::vector<Triangle> triangles;
        for (int t = 0; t < 24; ++t) {
            triangles.push_back({static_cast<uint32_t>(random() % 14), static_cast<uint32_t>(random() % 14),
                                 static_cast<uint32_t>(random() % 14)});
        }
        const Mesh mesh = from_triangles(std::move(positions), std::move(triangles));
        const std::vector<double> found = solve(mesh, {vertex_source(0)}, infinity, exact);
        const std::vector<double> above = graph_distances(mesh, 0, 12, false);
        const std::vector<double> below = graph_distances(mesh, 0, 12, true);
        INFO("round " << round);
        for (uint32_t v = 1; v < 14; ++v) {
            INFO("vertex " << v);
            if (std::isinf(above[v])) {
                CHECK(std::isinf(found[v]));
            } else {
                CHECK(found[v] <= above[v] + roundings);
                CHECK(found[v] >= below[v] - roundings);
            }
        }
    }
}

#include "engine/core/error.h"
#include "tests/unit/distance/surfaces.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::surfaces;

namespace {

// Every window is laid out anew in each triangle that it crosses: some 100 times a few eps.
constexpr double roundings = 1e-13;

double to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::length(p - glm::mix(a, b, t));
}

/// The straight line between two places of a plane mesh as points on its edges, from triangle to triangle.
std::vector<SurfacePoint> crossing_line(const Mesh& mesh, const Vec3& a, const Vec3& b) {
    std::vector<std::pair<double, SurfacePoint>> found;
    const auto cross = [](const Vec3& u, const Vec3& v) { return u.x * v.y - u.y * v.x; };
    for (uint32_t f = 0; f < mesh.triangles.size(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const Vec3 p = mesh.positions[mesh.triangles[f][k]],
                       q = mesh.positions[mesh.triangles[f][(k + 1) % 3]];
            const double side_p = cross(b - a, p - a), side_q = cross(b - a, q - a);
            const double s = side_p / (side_p - side_q);
            const double t = glm::dot(glm::mix(p, q, s) - a, b - a) / glm::dot(b - a, b - a);
            if (side_p * side_q < 0 && t > 0 && t < 1 && p.x + 1e-3 * p.y < q.x + 1e-3 * q.y) {
                Vec3 weights(0);
                weights[k] = 1 - s;
                weights[(k + 1) % 3] = s;
                found.push_back({t, {f, weights, no_index}});
            }
        }
    }
    std::sort(found.begin(), found.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    std::vector<SurfacePoint> line;
    for (const auto& [t, point] : found) {
        if (line.empty() || glm::length(place(mesh, line.back()) - place(mesh, point)) > 1e-9) {
            line.push_back(point);
        }
    }
    return line;
}

std::vector<double> solve_lines(const Mesh& mesh, const DistanceSources& sources, DistanceMethod method) {
    return GeodesicSolver(mesh, mesh.positions).solve(sources, infinity, method).dense(mesh.vertex_count());
}

} // namespace

TEST_CASE("the distance from a polyline in a plane is that of its nearest point") {
    const Mesh mesh = plane(20, 20, 1, 1, 0.25);
    DistanceSources sources;
    sources.polylines.push_back(crossing_line(mesh, {0.22, 0.31, 0}, {0.71, 0.64, 0}));
    REQUIRE(sources.polylines[0].size() > 10);
    const Vec3 a = place(mesh, sources.polylines[0].front()), b = place(mesh, sources.polylines[0].back());
    const std::vector<double> exact = solve_lines(mesh, sources, DistanceMethod::exact);
    const std::vector<double> near = solve_lines(mesh, sources, DistanceMethod::approximate);
    double worst = 0, worst_near = 0;
    for (size_t v = 0; v < exact.size(); ++v) {
        const double expected = to_segment(mesh.positions[v], a, b);
        worst = std::max(worst, std::abs(exact[v] - expected));
        worst_near = std::max(worst_near, std::abs(near[v] - expected));
    }
    CHECK(worst < roundings);
    // Vertices around the line that hold no piece of it see its points only: some of a cell (0.05).
    CHECK(worst_near < 0.02);
}

TEST_CASE("a polyline along edges and vertices is a source on both sides") {
    const Mesh mesh = plane(20, 20, 1, 1, 0);
    DistanceSources sources;
    sources.polylines.emplace_back();
    for (uint32_t i = 5; i <= 15; ++i) {
        sources.polylines[0].push_back(vertex_source(10 * 21 + i));
    }
    const std::vector<double> exact = solve_lines(mesh, sources, DistanceMethod::exact);
    double worst = 0;
    for (size_t v = 0; v < exact.size(); ++v) {
        worst = std::max(worst,
                         std::abs(exact[v] - to_segment(mesh.positions[v], {0.25, 0.5, 0}, {0.75, 0.5, 0})));
    }
    CHECK(worst < roundings);
}

TEST_CASE("a whole face is nowhere away from itself and sends its distance from its rim") {
    const Mesh mesh = plane(12, 12, 1, 1, 0.2);
    DistanceSources sources;
    sources.triangles = {140};
    const std::vector<double> exact = solve_lines(mesh, sources, DistanceMethod::exact);
    const std::vector<double> near = solve_lines(mesh, sources, DistanceMethod::approximate);
    const Triangle& t = mesh.triangles[140];
    double worst = 0, worst_near = 0;
    for (size_t v = 0; v < exact.size(); ++v) {
        double expected = infinity;
        for (int k = 0; k < 3; ++k) {
            expected = std::min(expected, to_segment(mesh.positions[v], mesh.positions[t[k]],
                                                     mesh.positions[t[(k + 1) % 3]]));
        }
        worst = std::max(worst, std::abs(exact[v] - expected));
        worst_near = std::max(worst_near, std::abs(near[v] - expected));
    }
    CHECK(worst < roundings);
    CHECK(worst_near < 0.02);
}

TEST_CASE("a line around a prism gives straight heights on both sides") {
    const int columns = 24, rows = 10;
    const Mesh mesh = prism(columns, rows, 2);
    DistanceSources sources;
    sources.polylines.emplace_back();
    for (int i = 0; i <= columns; ++i) {
        sources.polylines[0].push_back(vertex_source(static_cast<uint32_t>(4 * (columns + 1) + i % columns)));
    }
    const std::vector<double> exact = solve_lines(mesh, sources, DistanceMethod::exact);
    double worst = 0;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            worst = std::max(worst, std::abs(exact[j * (columns + 1) + i] - 0.2 * std::abs(j - 4)));
        }
    }
    CHECK(worst < roundings);
}

TEST_CASE("a polyline that leaves its triangles is refused") {
    const Mesh mesh = plane(4, 4, 1, 1, 0);
    const GeodesicSolver solver(mesh, mesh.positions);
    DistanceSources sources;
    sources.polylines.push_back({vertex_source(0), vertex_source(24)});
    CHECK_THROWS_WITH(solver.solve(sources), Catch::Contains("no common triangle"));
    sources.polylines.clear();
    sources.triangles = {32};
    CHECK_THROWS_AS(solver.solve(sources), InputError);
}

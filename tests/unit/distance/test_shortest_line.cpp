#include "tests/unit/distance/surfaces.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::surfaces;

namespace {

double length_of(const Mesh& mesh, const std::vector<SurfacePoint>& line) {
    double length = line.empty() ? infinity : 0;
    for (size_t i = 1; i < line.size(); ++i) {
        length += glm::length(place(mesh, line[i]) - place(mesh, line[i - 1]));
    }
    return length;
}

/// That the line begins and ends where it should and that each two neighbours lie in one triangle.
void check_line(const GeodesicSolver& solver, const Mesh& mesh, const std::vector<SurfacePoint>& line,
                const SurfacePoint& from, const SurfacePoint& to) {
    REQUIRE(line.size() >= 2);
    CHECK(glm::length(place(mesh, line.front()) - place(mesh, from)) < 1e-12);
    CHECK(glm::length(place(mesh, line.back()) - place(mesh, to)) < 1e-12);
    bool together = true;
    for (size_t i = 1; i < line.size(); ++i) {
        together = together && solver.share_triangle(line[i - 1], line[i]);
    }
    CHECK(together);
}

struct RandomPoints {
    std::mt19937 random{7};
    double uniform() { return random() / 4294967296.0; }
    SurfacePoint operator()(const Mesh& mesh) {
        SurfacePoint point;
        if (random() % 3 == 0) {
            point.vertex = static_cast<uint32_t>(random() % mesh.vertex_count());
            return point;
        }
        point.triangle = static_cast<uint32_t>(random() % mesh.triangles.size());
        const double a = uniform(), b = random() % 3 == 0 ? 0 : (1 - a) * uniform();
        point.barycentric = {a, b, 1 - a - b};
        return point;
    }
};

} // namespace

TEST_CASE("a shortest line on a plane is straight, between points of any kind") {
    const Mesh mesh = plane(30, 20, 3, 2, 0.3);
    const GeodesicSolver solver(mesh, mesh.positions);
    RandomPoints random;
    for (int i = 0; i < 60; ++i) {
        const SurfacePoint a = random(mesh), b = random(mesh);
        if (solver.share_triangle(a, b)) {
            continue;
        }
        const std::vector<SurfacePoint> line = solver.shortest_line(a, b);
        check_line(solver, mesh, line, a, b);
        CHECK(length_of(mesh, line) == Approx(glm::length(place(mesh, a) - place(mesh, b))).epsilon(1e-11));
    }
}

TEST_CASE("a shortest line over folds is the straight line of the unfolded sheet") {
    const int columns = 24;
    const Mesh flat = plane(columns, 8, columns, 8, 0);
    const Mesh folded = folded_strip(flat, columns);
    const GeodesicSolver solver(folded, folded.positions);
    RandomPoints random;
    for (int i = 0; i < 40; ++i) {
        const SurfacePoint a = random(flat), b = random(flat);
        if (!solver.share_triangle(a, b)) {
            const std::vector<SurfacePoint> line = solver.shortest_line(a, b);
            check_line(solver, folded, line, a, b);
            CHECK(length_of(folded, line) ==
                  Approx(glm::length(place(flat, a) - place(flat, b))).epsilon(1e-11));
        }
    }
}

TEST_CASE(
    "lines are geodesics as long as the exact distance, around saddles, edges with three faces and holes") {
    Mesh holed = plane(24, 24, 1, 1, 0.2);
    std::erase_if(holed.triangles, [&](const Triangle& t) {
        const Vec3 c = (holed.positions[t[0]] + holed.positions[t[1]] + holed.positions[t[2]]) / 3.0;
        return std::abs(c.x - 0.5) < 0.3 && std::abs(c.y - 0.5) < 0.08;
    });
    for (const Mesh& mesh : {bumps(24, 0.15), sphere(3), prism(16, 12, 4), three_sheets(7).mesh,
                             from_triangles(holed.positions, holed.triangles)}) {
        const GeodesicSolver solver(mesh, mesh.positions);
        RandomPoints random;
        int count = 0, shortest = 0;
        for (int i = 0; i < 40; ++i) {
            const SurfacePoint a = random(mesh), b = vertex_source(static_cast<uint32_t>(
                                                     random.random() % mesh.vertex_count()));
            const double exact =
                solver.solve({&a, 1}, infinity, DistanceMethod::exact).dense(mesh.vertex_count())[b.vertex];
            if (std::isinf(exact) || solver.share_triangle(a, b)) {
                continue;
            }
            const std::vector<SurfacePoint> line = solver.shortest_line(a, b);
            check_line(solver, mesh, line, a, b);
            // Of two ways that pass a vertex on either side it may be the other one, a little longer.
            CHECK(length_of(mesh, line) > exact * (1 - 1e-11));
            CHECK(length_of(mesh, line) < exact * (1 + 1e-4));
            ++count;
            shortest += length_of(mesh, line) < exact * (1 + 1e-10) ? 1 : 0;
        }
        CHECK(count > 20);
        CHECK(shortest >= 0.9 * count);
    }
}

TEST_CASE("there is no line to another component or to an isolated vertex") {
    Mesh mesh = plane(2, 2, 1, 1, 0);
    for (const Vec3& p : {Vec3(5, 0, 0), Vec3(6, 0, 0), Vec3(5, 1, 0), Vec3(9, 9, 9)}) {
        mesh.positions.push_back(p);
    }
    mesh = from_triangles(mesh.positions, {{0, 1, 4}, {0, 4, 3}, {9, 10, 11}});
    const GeodesicSolver solver(mesh, mesh.positions);
    CHECK(solver.shortest_line(vertex_source(0), vertex_source(9)).empty());
    CHECK(solver.shortest_line(vertex_source(12), vertex_source(0)).empty());
    CHECK(solver.shortest_line(vertex_source(0), vertex_source(12)).empty());
    CHECK(solver.shortest_line(vertex_source(1), vertex_source(3)).size() == 3);
}

#include "engine/forge/kept_solvers.h"

#include "engine/distance/smoothed_surface.h"
#include "engine/refine/point_vertices.h"
#include "tests/unit/distance/surfaces.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::surfaces;

TEST_CASE("kept solvers give the distances of new ones through divisions and moves, smoothed or not") {
    Mesh mesh = bumps(40, 0.1);
    KeptSolvers solvers;
    const std::vector<SurfacePoint> source = {vertex_source(300)};
    const auto check = [&] {
        for (const uint32_t rounds : {0U, 4U}) {
            const std::vector<Vec3> smoothed = smoothed_positions(mesh, mesh.positions, rounds);
            const std::vector<double> expected = GeodesicSolver(mesh, smoothed)
                                                     .solve(source, infinity, DistanceMethod::exact)
                                                     .dense(mesh.vertex_count());
            const std::vector<double> found = solvers.solver(mesh, mesh.positions, rounds)
                                                  .solve(source, infinity, DistanceMethod::exact)
                                                  .dense(mesh.vertex_count());
            CHECK(worst_relative(found, expected, 1e-3) < 1e-10);
        }
    };
    const auto divide = [&](uint32_t first) {
        std::vector<SurfacePoint> points;
        for (uint32_t t = first; t < first + 12; t += 3) {
            points.push_back({t, Vec3(0.3, 0.3, 0.4), no_index});
        }
        RefinedMesh refined = make_vertices(mesh, points).refined;
        mesh = std::move(refined.mesh);
        solvers.divided(refined.roots);
    };
    check();
    const GeodesicSolver* const first = &solvers.solver(mesh, mesh.positions, 0);
    divide(1000);
    check();
    // Two divisions and a move before anything is measured again.
    divide(1010);
    divide(2000);
    for (uint32_t v = 500; v < 540; ++v) {
        mesh.positions[v].z += 0.01;
    }
    solvers.moved();
    check();
    CHECK(&solvers.solver(mesh, mesh.positions, 0) == first);
}

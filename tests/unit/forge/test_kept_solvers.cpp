#include "engine/forge/kept_solvers.h"

#include "engine/distance/smoothed_surface.h"
#include "engine/refine/point_vertices.h"
#include "tests/unit/distance/surfaces.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::surfaces;

namespace {

const std::vector<SurfacePoint> source = {vertex_source(300)};

/// A mesh that is divided and moved, step by step.
struct Edited {
    Mesh file = bumps(40, 0.1);
    Mesh mesh = file;
    RefinementHistory history{file};
    uint64_t number = new_surface_number();

    EditedSurface surface() const { return {mesh, mesh.positions, history, number}; }

    void divide(uint32_t first) {
        std::vector<SurfacePoint> points;
        for (uint32_t t = first; t < first + 12; t += 3) {
            points.push_back({t, Vec3(0.3, 0.3, 0.4), no_index});
        }
        RefinedMesh refined = make_vertices(mesh, points).refined;
        history.add(refined);
        mesh = std::move(refined.mesh);
        number = new_surface_number();
    }

    void move(uint32_t first) {
        for (uint32_t v = first; v < first + 40; ++v) {
            mesh.positions[v].z += 0.01;
        }
        number = new_surface_number();
    }

    std::vector<double> distances(KeptSolvers& solvers, uint32_t rounds, DistanceMethod method) const {
        return solvers.solver(surface(), rounds).solve(source, infinity, method).dense(mesh.vertex_count());
    }
};

} // namespace

TEST_CASE("kept solvers give the distances of new ones through divisions and moves, smoothed or not") {
    Edited edited;
    KeptSolvers solvers;
    const auto check = [&] {
        for (const uint32_t rounds : {0U, 4U}) {
            const std::vector<Vec3> smoothed = smoothed_positions(edited.mesh, edited.mesh.positions, rounds);
            const std::vector<double> expected = GeodesicSolver(edited.mesh, smoothed)
                                                     .solve(source, infinity, DistanceMethod::exact)
                                                     .dense(edited.mesh.vertex_count());
            CHECK(worst_relative(edited.distances(solvers, rounds, DistanceMethod::exact), expected, 1e-3) <
                  1e-10);
        }
    };
    check();
    edited.divide(1000);
    check();
    // Two divisions and a move before anything is measured again.
    edited.divide(1010);
    edited.divide(2000);
    edited.move(500);
    check();
}

TEST_CASE(
    "distances of kept solvers depend on the surface alone, not on those asked for before, bit for bit") {
    Edited edited;
    KeptSolvers used;
    std::vector<Edited> states = {edited};
    edited.move(500);
    states.push_back(edited);
    edited.divide(1000);
    states.push_back(edited);
    edited.move(700);
    states.push_back(edited);
    for (const size_t i : {size_t{0}, size_t{1}, size_t{3}, size_t{2}, size_t{3}, size_t{1}, size_t{0}}) {
        for (const DistanceMethod method : {DistanceMethod::approximate, DistanceMethod::exact}) {
            for (const uint32_t rounds : {0U, 4U}) {
                KeptSolvers fresh;
                CHECK(states[i].distances(used, rounds, method) ==
                      states[i].distances(fresh, rounds, method));
            }
        }
    }
}

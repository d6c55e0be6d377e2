#include "engine/core/error.h"
#include "tests/unit/distance/surfaces.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::surfaces;

TEST_CASE("a march grown in steps gives the numbers of one call, bit for bit") {
    const Mesh mesh = bumps(40, 0.15);
    const GeodesicSolver solver(mesh, mesh.positions);
    DistanceSources sources;
    sources.points = {vertex_source(500), {900, {0.2, 0.2, 0.6}, no_index}};
    for (const DistanceMethod method : {DistanceMethod::approximate, DistanceMethod::exact}) {
        GeodesicMarch march = solver.march(method);
        march.add(sources);
        for (const double radius : {0.01, 0.05, 0.051, 0.02, 0.3, 0.8, 3.0}) {
            march.grow(radius);
            const double reach = radius == 0.02 ? 0.051 : radius;
            CHECK(march.field().method == method);
            CHECK(march.field().dense(mesh.vertex_count()) ==
                  solver.solve(sources, reach, method).dense(mesh.vertex_count()));
        }
    }
}

TEST_CASE("sources added to a march give what they give together") {
    const Mesh mesh = bumps(40, 0.15);
    const GeodesicSolver solver(mesh, mesh.positions);
    DistanceSources first, second, both;
    first.points = {vertex_source(500)};
    second.points = {vertex_source(1200), {900, {0.2, 0.2, 0.6}, no_index}};
    both.points = {first.points[0], second.points[0], second.points[1]};
    for (const DistanceMethod method : {DistanceMethod::approximate, DistanceMethod::exact}) {
        GeodesicMarch march = solver.march(method);
        march.add(first);
        march.grow(0.6);
        march.add(second);
        const std::vector<double> expected = solver.solve(both, 0.6, method).dense(mesh.vertex_count());
        // Where two sources meet, an approximate front that came first may leave some tenths of a per cent.
        const double bound = method == DistanceMethod::exact ? 1e-12 : 0.01;
        CHECK(worst_relative(march.field().dense(mesh.vertex_count()), expected, 0.05) < bound);
        march.grow(2);
        CHECK(worst_relative(march.field().dense(mesh.vertex_count()),
                             solver.solve(both, 2, method).dense(mesh.vertex_count()), 0.05) < bound);
    }
}

TEST_CASE("a march outlives its solver and hands its workspace on") {
    const Mesh mesh = bumps(10, 0.1);
    DistanceSources sources;
    sources.points = {vertex_source(50)};
    auto solver = std::make_unique<GeodesicSolver>(mesh, mesh.positions);
    const std::vector<double> expected = solver->solve(sources, infinity, DistanceMethod::exact).dense(121);
    GeodesicMarch march = solver->march(DistanceMethod::exact);
    solver.reset();
    march.add(sources);
    march.grow(infinity);
    CHECK(march.field().dense(121) == expected);
    CHECK_THROWS_AS(march.grow(NAN), InputError);
}

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

TEST_CASE("a march that chooses its method chooses as one call does, whatever it was before") {
    const Mesh mesh = bumps(90, 0.15);
    const GeodesicSolver solver(mesh, mesh.positions);
    DistanceSources sources;
    sources.points = {vertex_source(4140)};
    GeodesicMarch march = solver.march(DistanceMethod::automatic);
    march.add(sources);
    size_t exact = 0;
    for (const double radius : {0.1, 0.3, 0.35, 0.5, 0.7, 2.0}) {
        march.grow(radius);
        const DistanceField expected = solver.solve(sources, radius);
        CHECK(march.field().method == expected.method);
        CHECK(march.field().dense(mesh.vertex_count()) == expected.dense(mesh.vertex_count()));
        exact += expected.method == DistanceMethod::exact ? 1 : 0;
    }
    CHECK(exact >= 2);
    CHECK(exact <= 4); // both methods were met
}

TEST_CASE("a march goes on where it stopped: its steps are those of one call, the last ones its own") {
    const Mesh mesh = bumps(60, 0.15);
    const GeodesicSolver solver(mesh, mesh.positions);
    DistanceSources sources;
    sources.points = {vertex_source(1830)};
    for (const DistanceMethod method : {DistanceMethod::approximate, DistanceMethod::exact}) {
        GeodesicMarch whole = solver.march(method);
        whole.add(sources);
        whole.grow(0.5);
        GeodesicMarch march = solver.march(method);
        march.add(sources);
        for (const double radius : {0.1, 0.2, 0.3, 0.4, 0.49}) {
            march.grow(radius);
        }
        const size_t before = march.steps();
        march.grow(0.5);
        CHECK(march.steps() <= whole.steps() + whole.steps() / 100);
        CHECK(march.steps() > before);
        // A ring of 0.01 has 4 % of the area, and windows through it come from all over the disc.
        CHECK(march.steps() - before <= whole.steps() / 8);
        const size_t grown = march.steps();
        march.grow(0.5);
        march.grow(0.2);
        CHECK(march.steps() == grown);
    }
}

TEST_CASE("a source that comes later costs what it improves, not what is there") {
    const Mesh mesh = bumps(60, 0.15);
    const GeodesicSolver solver(mesh, mesh.positions);
    DistanceSources first, second;
    first.points = {vertex_source(1830)};
    second.points = {vertex_source(61)}; // near a corner: nearest to a small part
    for (const DistanceMethod method : {DistanceMethod::approximate, DistanceMethod::exact}) {
        GeodesicMarch march = solver.march(method);
        march.add(first);
        march.grow(2);
        const size_t before = march.steps();
        const std::vector<double> alone = march.field().dense(mesh.vertex_count());
        march.add(second);
        const std::vector<double> both = march.field().dense(mesh.vertex_count());
        size_t nearer = 0;
        for (size_t v = 0; v < alone.size(); ++v) {
            nearer += both[v] < alone[v] ? 1 : 0;
        }
        INFO(nearer << " of " << alone.size() << " are nearer");
        CHECK(nearer > 100);
        // Its front also looks a little beyond where it stops to be the nearest.
        const double share = static_cast<double>(nearer) / static_cast<double>(alone.size());
        CHECK(static_cast<double>(march.steps() - before) <= 1.5 * share * static_cast<double>(before));
    }
}

#include "engine/mesh/place_order.h"

#include "engine/forge/edit_region.h"
#include "engine/mesh/sample_shapes.h"
#include "tests/support/forging.h"

#include <catch2/catch.hpp>
#include <numeric>
#include <random>

using namespace anvil;
using namespace anvil::test;

namespace {

/// Mean distance between points that follow each other.
double mean_jump(std::span<const Vec3> points, std::span<const uint32_t> order) {
    double sum = 0;
    for (size_t i = 1; i < order.size(); ++i) {
        sum += glm::length(points[order[i]] - points[order[i - 1]]);
    }
    return sum / static_cast<double>(order.size() - 1);
}

/// Vertices numbered at random.
Mesh shuffled_sphere() {
    const Mesh sphere = make_sample("icosphere", 2562);
    std::vector<uint32_t> number(sphere.vertex_count());
    std::iota(number.begin(), number.end(), 0U);
    std::shuffle(number.begin(), number.end(), std::mt19937(5));
    Mesh mesh = sphere;
    for (uint32_t v = 0; v < number.size(); ++v) {
        mesh.positions[number[v]] = sphere.positions[v];
    }
    for (uint32_t& corner : mesh.corners) {
        corner = number[corner];
    }
    triangulate(mesh);
    return mesh;
}

} // namespace

TEST_CASE("points ordered by place are each there once, and follow near ones, whatever order they come in") {
    std::vector<Vec3> points = make_sample("icosphere", 10242).positions;
    std::shuffle(points.begin(), points.end(), std::mt19937(3));
    std::vector<uint32_t> order = order_by_place(points);
    // Edges are about 0.036 long; a random order has mean jumps of 4/3.
    CHECK(mean_jump(points, order) < 3 * 0.036);
    std::sort(order.begin(), order.end());
    std::vector<uint32_t> all(points.size());
    std::iota(all.begin(), all.end(), 0U);
    CHECK(order == all);
    CHECK(order_by_place({}).empty());
    CHECK(order_by_place(std::vector<Vec3>(3, Vec3(1))) == std::vector<uint32_t>{0, 1, 2});
}

TEST_CASE("a region is a list by place that finds its vertices, without the pinned ones") {
    const Mesh mesh = shuffled_sphere();
    const Recipe recipe =
        edit_recipe("{'kind': 'translate', 'handles': [ {'at': {'vertex': 7}, 'by': [0,0,1]} ], "
                    "'pinned': [ {'vertex': 9}, {'vertex': 7} ], 'metric': 'euclidean', "
                    "'radius': 0.8}");
    const RefinementHistory history(mesh);
    KeptSolvers solvers;
    SurfaceState surface(mesh, mesh.positions, history, solvers);
    const EditRegion region = find_region(recipe.edits[0], "edits[0]", surface);
    const size_t n = region.vertices.size();
    REQUIRE(n > 300);
    REQUIRE(region.by_vertex.size() == n);
    std::vector<bool> listed(mesh.vertex_count(), false);
    for (size_t i = 0; i < n; ++i) {
        REQUIRE(region.index_of(region.vertices[i]) == i);
        REQUIRE((i == 0 || region.vertices[region.by_vertex[i - 1]] < region.vertices[region.by_vertex[i]]));
        listed[region.vertices[i]] = true;
        const double t = glm::length(mesh.positions[region.vertices[i]] - mesh.positions[7]) / 0.8;
        REQUIRE(std::abs(region.fields[i] - t) <= 1e-15);
    }
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const bool within = glm::length(mesh.positions[v] - mesh.positions[7]) <= 0.8 && v != 7 && v != 9;
        REQUIRE(listed[v] == within);
        REQUIRE((listed[v] || region.index_of(v) == n));
    }
    std::vector<uint32_t> ascending = region.vertices;
    std::sort(ascending.begin(), ascending.end());
    CHECK(mean_jump(mesh.positions, region.vertices) < 0.3 * mean_jump(mesh.positions, ascending));
}

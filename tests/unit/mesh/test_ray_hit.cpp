#include "engine/mesh/sample_shapes.h"
#include "engine/mesh/search_tree.h"
#include "engine/mesh/surface_point.h"

#include <catch2/catch.hpp>
#include <random>

using namespace anvil;

namespace {

/// Where the ray meets the triangle's plane within the triangle, by solving for barycentrics: no formula of
/// the tree's.
double distance_to(const Vec3& origin, const Vec3& direction, const std::array<Vec3, 3>& t) {
    const glm::dmat3 system(t[1] - t[0], t[2] - t[0], -direction);
    if (std::abs(glm::determinant(system)) < 1e-300) {
        return infinity;
    }
    const Vec3 solution = glm::inverse(system) * (origin - t[0]);
    const bool inside = solution.x >= 0 && solution.y >= 0 && solution.x + solution.y <= 1 && solution.z >= 0;
    return inside ? solution.z : infinity;
}

} // namespace

TEST_CASE("a ray meets what is first of all triangles, one by one") {
    const Mesh mesh = make_sample("hand", 2000);
    const SearchTree tree(mesh.positions, mesh.triangles);
    const Box box = bounds(mesh);
    std::mt19937 generator(4);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto anywhere = [&] {
        return box.centre() + box.diagonal() * Vec3(unit(generator), unit(generator), unit(generator));
    };
    size_t hits = 0;
    for (int i = 0; i < 400; ++i) {
        const Vec3 origin = anywhere();
        const Vec3 direction = box.centre() + 0.2 * (anywhere() - box.centre()) - origin;
        double nearest = infinity;
        for (const Triangle& t : mesh.triangles) {
            nearest = std::min(
                nearest, distance_to(origin, direction,
                                     {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}));
        }
        const ClosestPoint found = tree.first_hit(origin, direction);
        REQUIRE(found.found() == std::isfinite(nearest));
        if (found.found()) {
            ++hits;
            CHECK(found.distance == Approx(nearest).epsilon(1e-9));
            CHECK(glm::length(found.position - (origin + found.distance * direction)) <=
                  1e-9 * box.diagonal());
            CHECK(glm::length(position(mesh, mesh.positions, {found.triangle, found.barycentric}) -
                              found.position) <= 1e-12 * box.diagonal());
        }
    }
    CHECK(hits > 100);
}

TEST_CASE("rays along the axes and through edges of a flat square find it, rays beside it do not") {
    const Mesh mesh = make_sample("plane", 400);
    const SearchTree tree(mesh.positions, mesh.triangles);
    for (int i = -9; i <= 9; ++i) { // through vertices and edges
        const ClosestPoint found = tree.first_hit(Vec3(0.05 * i, 0, 3), Vec3(0, 0, -1));
        REQUIRE(found.found());
        CHECK(found.distance == Approx(3));
    }
    CHECK_FALSE(tree.first_hit(Vec3(0.6, 0, 3), Vec3(0, 0, -1)).found());
    CHECK_FALSE(tree.first_hit(Vec3(0, 0, 3), Vec3(0, 0, 1)).found());
    CHECK_FALSE(tree.first_hit(Vec3(0, 0, 3), Vec3(1, 0, 0)).found());
}

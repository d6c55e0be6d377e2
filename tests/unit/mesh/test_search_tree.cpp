#include "engine/core/error.h"
#include "engine/mesh/search_tree.h"
#include "engine/mesh/surface_point.h"

#include <catch2/catch.hpp>
#include <random>

using namespace anvil;

namespace {

struct Soup {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
};

/// Random triangles; every third one is degenerate (a point, a segment, a needle).
Soup random_soup(size_t count, uint32_t seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    const auto point = [&] {
        return Vec3(coordinate(generator), coordinate(generator), coordinate(generator));
    };
    Soup soup;
    for (uint32_t t = 0; t < count; ++t) {
        const Vec3 a = point();
        Vec3 b = a + 0.2 * point(), c = a + 0.2 * point();
        if (t % 9 == 0) {
            b = c = a;
        } else if (t % 9 == 3) {
            c = a + 0.3 * (b - a);
        } else if (t % 9 == 6) {
            c = 0.5 * (a + b) + 1e-9 * point();
        }
        soup.positions.insert(soup.positions.end(), {a, b, c});
        soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return soup;
}

/// Least value on [low, high] of a convex function.
template <class Function>
double least_value(double low, double high, const Function& f) {
    for (int i = 0; i < 90; ++i) {
        const double m1 = low + (high - low) / 3, m2 = high - (high - low) / 3;
        if (f(m1) < f(m2)) {
            high = m2;
        } else {
            low = m1;
        }
    }
    return f(0.5 * (low + high));
}

/// Distance to the triangle a + t (b - a) + u (c - b), 0 <= u <= t <= 1, by two nested searches: slow, but it
/// shares no formula with the tree.
double distance_by_search(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    return least_value(0, 1, [&](double u) {
        return least_value(u, 1, [&](double t) { return glm::length(a + t * (b - a) + u * (c - b) - p); });
    });
}

SurfacePoint on_face(double u, double v, double w) {
    return {0, {u, v, w}, no_index};
}

} // namespace

TEST_CASE("The closest point of a triangle is the one that a search over the triangle finds") {
    const Soup soup = random_soup(90, 1);
    std::mt19937 generator(2);
    std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
    for (const Triangle& t : soup.triangles) {
        const Vec3 p(coordinate(generator), coordinate(generator), coordinate(generator));
        const Vec3 &a = soup.positions[t[0]], &b = soup.positions[t[1]], &c = soup.positions[t[2]];
        const ClosestPoint found = closest_on_triangle(p, a, b, c);
        // The search stops where distances differ by rounding: sqrt(eps) in place, eps in distance.
        CHECK(found.distance == Approx(distance_by_search(p, a, b, c)).margin(1e-12));
        CHECK(glm::length(p - found.position) == Approx(found.distance).margin(1e-14));
        const Vec3 w = found.barycentric;
        CHECK(std::min({w.x, w.y, w.z}) >= 0);
        CHECK(w.x + w.y + w.z == Approx(1).margin(1e-15));
        CHECK(glm::length(w.x * a + w.y * b + w.z * c - found.position) < 1e-14);
    }
}

TEST_CASE("The tree finds what a loop over all triangles finds, degenerate triangles included") {
    for (const size_t count : {1, 4, 5, 37, 1000}) {
        const Soup soup = random_soup(count, 3);
        const SearchTree tree(soup.positions, soup.triangles);
        CHECK(tree.triangle_count() == count);
        std::mt19937 generator(4);
        std::uniform_real_distribution<double> coordinate(-2, 2);
        for (int i = 0; i < 200; ++i) {
            const Vec3 p(coordinate(generator), coordinate(generator), coordinate(generator));
            double least = infinity;
            uint32_t first = no_index;
            for (uint32_t t = 0; t < count; ++t) {
                const Triangle& v = soup.triangles[t];
                const double d =
                    closest_on_triangle(p, soup.positions[v[0]], soup.positions[v[1]], soup.positions[v[2]])
                        .distance;
                if (d < least) {
                    least = d;
                    first = t;
                }
            }
            const ClosestPoint found = tree.closest(p);
            REQUIRE(found.triangle == first);
            REQUIRE(found.distance == least);
            CHECK_FALSE(tree.closest(p, 0.999 * least).found());
            CHECK(tree.closest(p, 1.001 * least).triangle == first);
        }
    }
}

TEST_CASE("Coincident triangles, an empty tree and queries that are not finite are ordinary") {
    const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<Triangle> same(10000, Triangle{0, 1, 2});
    const SearchTree tree(positions, same);
    const ClosestPoint found = tree.closest({0.25, 0.25, 2});
    CHECK(found.triangle == 0);
    CHECK(found.distance == 2);
    CHECK(found.barycentric == Vec3(0.5, 0.25, 0.25));
    CHECK_FALSE(tree.closest({std::nan(""), 0, 0}).found());
    CHECK_FALSE(tree.closest({infinity, 0, 0}).found());
    CHECK_FALSE(SearchTree({}, {}).closest({0, 0, 0}).found());
    CHECK(tree.closest({0, 0, 0}, 0).triangle == 0);
}

TEST_CASE("The answer scales with the mesh by powers of two, bit for bit, and at extreme sizes") {
    const Soup soup = random_soup(300, 5);
    const SearchTree tree(soup.positions, soup.triangles);
    for (const double scale : {std::ldexp(1.0, 200), std::ldexp(1.0, -200)}) {
        std::vector<Vec3> scaled;
        for (const Vec3& p : soup.positions) {
            scaled.push_back(scale * p);
        }
        const SearchTree scaled_tree(scaled, soup.triangles);
        std::mt19937 generator(6);
        std::uniform_real_distribution<double> coordinate(-2, 2);
        for (int i = 0; i < 100; ++i) {
            const Vec3 p(coordinate(generator), coordinate(generator), coordinate(generator));
            CHECK(scaled_tree.closest(scale * p).triangle == tree.closest(p).triangle);
            CHECK(scaled_tree.closest(scale * p).distance == scale * tree.closest(p).distance);
        }
    }
}

TEST_CASE("A tree of triangles that shrink geometrically stays shallow enough for its stack") {
    Soup soup;
    for (uint32_t t = 0; t < 3000; ++t) {
        const double s = std::ldexp(1.0, -static_cast<int>(t % 900));
        soup.positions.insert(soup.positions.end(), {Vec3(s, 0, 0), Vec3(s, s, 0), Vec3(s, 0, s)});
        soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    const SearchTree tree(soup.positions, soup.triangles);
    CHECK(tree.closest({-1, 0, 0}).distance == Approx(1));
    CHECK(tree.closest({2, 0, 0}).triangle == 0);
}

TEST_CASE("A surface point names its vertices, without zeros, and snaps to a vertex within 1e-9") {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
    mesh.add_polygon(std::vector<uint32_t>{0, 1, 2});
    mesh.triangles = {{0, 1, 2}};
    const VertexWeights inside = vertex_weights(mesh, on_face(0.5, 0.25, 0.25));
    REQUIRE(inside.count == 3);
    CHECK(inside.entries[1].vertex == 1);
    CHECK(inside.entries[1].weight == 0.25);
    CHECK(vertex_weights(mesh, on_face(0.5, 0.5, 0)).count == 2);
    const VertexWeights corner = vertex_weights(mesh, on_face(1e-10, 1 - 2e-10, 1e-10));
    REQUIRE(corner.count == 1);
    CHECK(corner.entries[0].vertex == 1);
    CHECK(corner.entries[0].weight == 1);
    CHECK(vertex_weights(mesh, on_face(-1e-12, 0.5, 0.5)).count == 2);
    CHECK(position(mesh, mesh.positions, on_face(0.5, 0.25, 0.25)) == Vec3(0.25, 0.25, 0));
    CHECK(position(mesh, mesh.positions, vertex_point(mesh, 2)) == mesh.positions[2]);
    CHECK(vertex_point(mesh, 3).triangle == no_index);
    CHECK(position(mesh, mesh.positions, vertex_point(mesh, 3)) == mesh.positions[3]);
    CHECK_THROWS_AS(vertex_point(mesh, 4), InputError);
}

TEST_CASE("A vertex that a degenerate triangle names twice is listed once") {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}};
    mesh.triangles = {{0, 1, 1}};
    const VertexWeights weights = vertex_weights(mesh, on_face(0.5, 0.25, 0.25));
    REQUIRE(weights.count == 2);
    CHECK(weights.entries[1].weight == 0.5);
}

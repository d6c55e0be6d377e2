#include "engine/mesh/closest_points.h"
#include "engine/mesh/sample_shapes.h"

#include <catch2/catch.hpp>
#include <random>

using namespace anvil;

namespace {

struct Soup {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;

    void add(const Vec3& a, const Vec3& b, const Vec3& c) {
        const auto first = static_cast<uint32_t>(positions.size());
        positions.insert(positions.end(), {a, b, c});
        triangles.push_back({first, first + 1, first + 2});
    }
};

class Random {
  public:
    explicit Random(uint32_t seed) : generator_(seed) {}
    double number() { return distribution_(generator_); }
    Vec3 point() {
        const double x = number();
        const double y = number();
        return {x, y, number()};
    }

  private:
    std::mt19937 generator_;
    std::uniform_real_distribution<double> distribution_{-1, 1};
};

/// Large and small triangles, needles of every sharpness, segments and points.
Soup random_soup(size_t count, uint32_t seed) {
    Random random(seed);
    Soup soup;
    for (size_t t = 0; t < count; ++t) {
        const double size = std::pow(10, -2 + 2 * random.number());
        const Vec3 a = random.point();
        const Vec3 b = a + size * random.point();
        const Vec3 between = a + (0.5 + 0.5 * random.number()) * (b - a);
        const Vec3 c = t % 3 == 0 ? a + size * random.point()
                                  : between + size * std::pow(10, -6 + 5 * random.number()) * random.point();
        soup.add(a, t % 17 == 0 ? a : b, t % 13 == 0 ? between : t % 17 == 0 ? a : c);
    }
    return soup;
}

Soup soup_of(const Mesh& mesh) {
    return {mesh.positions, mesh.triangles};
}

/// The corners of a cube's cells.
std::vector<Vec3> lattice(const Vec3& low, double spacing, int side) {
    std::vector<Vec3> points;
    for (int i = 0; i < side * side * side; ++i) {
        points.push_back(low + spacing * Vec3(i % side, i / side % side, i / (side * side)));
    }
    return points;
}

double brute_force(const Soup& soup, const Vec3& p) {
    double least = infinity;
    for (const auto& [a, b, c] : soup.triangles) {
        least = std::min(
            least, closest_on_triangle(p, soup.positions[a], soup.positions[b], soup.positions[c]).distance);
    }
    return least;
}

/// A found distance is that of all triangles looked at one by one; what is found is a point of its triangle.
void check_found(const Soup& soup, const std::vector<Vec3>& queries, const std::vector<double>& truth,
                 const std::vector<ClosestPoint>& found) {
    size_t wrong = 0;
    size_t off = 0;
    for (size_t i = 0; i < queries.size(); ++i) {
        wrong += found[i].distance == truth[i] ? 0 : 1;
        const auto& [a, b, c] = soup.triangles[found[i].triangle];
        const Vec3& w = found[i].barycentric;
        const Vec3 there = w.x * soup.positions[a] + w.y * soup.positions[b] + w.z * soup.positions[c];
        const double size = glm::length(soup.positions[a]) + glm::length(queries[i]) + truth[i];
        off += glm::length(there - found[i].position) <= 1e-14 * size ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(off == 0);
}

/// At once, in halves by a tracer that has found others before, and one by one.
void check_found(const Soup& soup, const std::vector<Vec3>& queries) {
    const SearchTree tree(soup.positions, soup.triangles);
    std::vector<double> truth;
    for (const Vec3& q : queries) {
        truth.push_back(brute_force(soup, q));
    }
    ClosestPointTracer tracer(tree);
    std::vector<ClosestPoint> found(queries.size());
    tracer.closest(queries, found);
    check_found(soup, queries, truth, found);
    const std::span<const Vec3> all(queries);
    const std::span<ClosestPoint> places(found);
    const size_t half = queries.size() / 2;
    std::fill(found.begin(), found.end(), ClosestPoint{});
    tracer.closest(all.subspan(half), places.subspan(half));
    tracer.closest(all.first(half), places.first(half));
    check_found(soup, queries, truth, found);
    for (size_t i = 0; i < queries.size(); ++i) {
        tracer.closest(all.subspan(i, 1), places.subspan(i, 1));
    }
    check_found(soup, queries, truth, found);
}

} // namespace

TEST_CASE("what is nearest to many queries at once is what is nearest to each of them") {
    for (const uint32_t seed : {1U, 2U, 3U}) {
        const Soup soup = random_soup(1500, seed);
        check_found(soup, lattice(Vec3(-0.2), 0.05, 9));
        check_found(soup, lattice(Vec3(0.5, -1.5, 0), 0.4, 5));
        check_found(soup, lattice(Vec3(0.1), 1e-5, 4));
        check_found(soup, lattice(Vec3(30, -20, 10), 3, 4));
    }
}

TEST_CASE("many queries at once: surfaces seen from near, from far and from within") {
    const Soup body = soup_of(make_sample("bust", 2000));
    const Soup torus = soup_of(make_sample("torus", 3000));
    const Soup cube = soup_of(make_sample("cube", 8));
    for (const Soup& soup : {body, torus, cube}) {
        check_found(soup, lattice(Vec3(-0.4, -0.5, -0.3), 0.03, 9));
        check_found(soup, lattice(Vec3(-2), 0.5, 9));
    }
    // From its centre a sphere's triangles are all equally far, to 2e-3.
    check_found(soup_of(make_sample("icosphere", 2562)), lattice(Vec3(-0.002), 0.0005, 9));
}

TEST_CASE("many queries at once: one triangle among a thousand times smaller ones hides none of them") {
    Random random(4);
    Soup soup;
    soup.add({-100, -100, 0}, {100, -100, 0}, {0, 150, 0});
    for (int t = 0; t < 1000; ++t) {
        const Vec3 a = random.point();
        soup.add(a, a + 0.1 * random.point(), a + 0.1 * random.point());
    }
    check_found(soup, lattice(Vec3(-0.5, -0.5, -0.1), 0.04, 9));
    check_found(soup, lattice(Vec3(20, 20, -8), 2, 6));
}

TEST_CASE("many queries at once: four triangles whose mean normal runs along their longest side") {
    // What is left of that side across the normal is rounding, of the size of all: of how many there are.
    // Each four are a leaf of the tree, and so is what else lies near them.
    for (int count = 3; count < 20; ++count) {
        Soup soup;
        for (int i = 0; i < count; ++i) {
            const Vec3 at(8 * i, 0, 0);
            soup.add(at + Vec3(0, 2, 0), at + Vec3(0, 1, 0), at + Vec3(1, 2, 0));
            soup.add(at + Vec3(1, 1, 0), at + Vec3(1, 2, 0), at + Vec3(0, 1, 0));
            soup.add(at + Vec3(0, 0, 1), at + Vec3(0, 0, 0), at + Vec3(1, 0, 1));
            soup.add(at + Vec3(0, 1, 0), at + Vec3(1, 0, 1), at + Vec3(0, 0, 0));
            for (int j = 0; j < 4; ++j) {
                const Vec3 beside = at + Vec3(3, 0.4 * j, 0);
                soup.add(beside, beside + Vec3(0, 0.3, 0), beside + Vec3(0, 0, 0.3));
            }
        }
        check_found(soup, lattice(Vec3(-2.1, -2, -2), 0.43, 12));
    }
}

TEST_CASE("many queries at once: distances scale with what they are between, and keep when all is far away") {
    const Soup soup = random_soup(600, 5);
    const std::vector<Vec3> queries = lattice(Vec3(-0.2), 0.06, 7);
    for (const double scale : {std::ldexp(1.0, -200), std::ldexp(1.0, 200)}) {
        Soup other = soup;
        for (Vec3& p : other.positions) {
            p *= scale;
        }
        std::vector<Vec3> scaled = queries;
        for (Vec3& p : scaled) {
            p *= scale;
        }
        check_found(other, scaled);
    }
    Soup moved = soup;
    for (Vec3& p : moved.positions) {
        p += Vec3(1e6, -2e6, 3e6);
    }
    check_found(moved, lattice(Vec3(1e6 - 0.2, -2e6, 3e6), 0.06, 7));
}

TEST_CASE(
    "many queries at once: no query, one, the same one again, none that is finite, and nothing to find") {
    const Soup soup = random_soup(300, 6);
    check_found(soup, {});
    check_found(soup, {Vec3(0.3)});
    check_found(soup, std::vector<Vec3>(50, Vec3(0.1, 0.2, 0.3)));
    const SearchTree tree(soup.positions, soup.triangles);
    std::vector<Vec3> queries(20, Vec3(0));
    queries[7].x = infinity;
    queries[9].y = std::numeric_limits<double>::quiet_NaN();
    std::vector<ClosestPoint> found(queries.size());
    ClosestPointTracer(tree).closest(queries, found);
    for (size_t i = 0; i < queries.size(); ++i) {
        CHECK(found[i].found() == (i != 7 && i != 9));
    }
    const SearchTree empty({}, {});
    ClosestPointTracer(empty).closest(queries, found);
    for (const ClosestPoint& point : found) {
        CHECK_FALSE(point.found());
    }
}

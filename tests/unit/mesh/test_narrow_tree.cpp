#include "engine/mesh/lasting_search.h"
#include "engine/mesh/sample_shapes.h"
#include "tests/support/failing_search.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace anvil;

namespace {

double number(std::mt19937& random) {
    return std::uniform_real_distribution<double>(-1, 1)(random);
}

Vec3 point(std::mt19937& random) {
    const double x = number(random);
    const double y = number(random);
    return {x, y, number(random)};
}

struct Soup {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
};

/// Triangles from large to tiny, needles of every sharpness, segments and points, some twice.
Soup random_soup(std::mt19937& random, size_t count, const Vec3& middle, double scale) {
    Soup soup;
    for (uint32_t t = 0; t < count; ++t) {
        const double size = std::pow(10, -2 + 2 * number(random));
        const Vec3 a = point(random);
        const Vec3 b = a + size * point(random);
        const Vec3 beside = std::pow(10, -6 + 5 * number(random)) * size * point(random);
        const Vec3 c = t % 3 == 0 ? a + size * point(random) : 0.3 * a + 0.7 * b + beside;
        for (const Vec3& corner : {a, t % 17 == 0 ? a : b, t % 13 == 0 ? a : c}) {
            soup.positions.push_back(middle + scale * corner);
        }
        soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
        if (t % 11 == 0) {
            soup.triangles.push_back({3 * t + 1, 3 * t + 2, 3 * t});
        }
    }
    return soup;
}

/// How many of these points have their nearest triangle not among what the kernel's formulas find in single
/// precision; how many those do not know.
struct Missed {
    size_t points = 0;
    size_t unknown = 0;
    double found = 0; ///< triangles a point
};

Missed missed(const SearchTree& tree, const std::vector<Vec3>& points) {
    const NarrowTree narrow = tree.narrowed();
    NarrowSearch search(narrow);
    std::vector<NearSlots> near(points.size());
    std::vector<glm::vec3> local;
    std::transform(points.begin(), points.end(), std::back_inserter(local),
                   [&](const Vec3& p) { return narrow.local(p); });
    search.find(local, near);
    Missed result;
    for (size_t i = 0; i < points.size(); ++i) {
        const auto end = std::find(near[i].begin(), near[i].end(), kernel::f32::NO_TRIANGLE);
        result.found += static_cast<double>(end - near[i].begin());
        if (end == near[i].begin()) {
            ++result.unknown;
            continue;
        }
        const ClosestPoint of_these = tree.closest_of(points[i], {near[i].begin(), end});
        const ClosestPoint truth = tree.closest(points[i]);
        result.points +=
            of_these.distance == truth.distance ? 0 : 1; // of equally near ones it may be another
    }
    result.found /= static_cast<double>(points.size());
    return result;
}

} // namespace

TEST_CASE("what single precision finds near a point always holds the nearest triangle", "[mesh]") {
    std::mt19937 random(1);
    // Far from the origin too: what counts is where a point is in the mesh's own box.
    for (const auto& [middle, scale] :
         {std::pair(Vec3(0), 1.0), {Vec3(3e5, -1e6, 2e4), 0.01}, {Vec3(0), 1e60}}) {
        const Soup soup = random_soup(random, 1500, middle, scale);
        const SearchTree tree(soup.positions, soup.triangles);
        std::vector<Vec3> points;
        for (int i = 0; i < 4000; ++i) {
            const double reach = i % 3 == 0 ? 1.2 : i % 3 == 1 ? 4 : 0.1;
            points.push_back(middle + reach * scale * point(random));
        }
        for (int i = 0; i < 1000; ++i) { // on triangles, their sides and corners, and a little beside
            const Triangle& t = soup.triangles[static_cast<size_t>(i) % soup.triangles.size()];
            const double u = i % 4 == 0 ? 0 : 0.5 + 0.5 * number(random);
            const double v = i % 5 == 0 ? 0 : (1 - u) * (0.5 + 0.5 * number(random));
            const Vec3 on =
                (1 - u - v) * soup.positions[t[0]] + u * soup.positions[t[1]] + v * soup.positions[t[2]];
            points.push_back(on + std::pow(10, -7 + 4 * number(random)) * scale * point(random));
        }
        const Missed result = missed(tree, points);
        CHECK(result.points == 0);
        CHECK(result.unknown < points.size() / 10);
    }
}

TEST_CASE("single precision leaves few triangles to be decided between", "[mesh]") {
    const Mesh mesh = make_sample("bust", 3000);
    const SearchTree tree(mesh.positions, mesh.triangles);
    std::mt19937 random(2);
    std::vector<Vec3> points;
    for (int i = 0; i < 1500; ++i) {
        const auto v = static_cast<size_t>(random()) % mesh.vertex_count();
        points.push_back(mesh.positions[v] + 0.1 * point(random));
    }
    const Missed result = missed(tree, points);
    CHECK(result.points == 0);
    // Nearest are a face, a side of two, or a corner of about six.
    CHECK(result.found < 3);
    CHECK(result.unknown < 15);
}

TEST_CASE("where too many triangles are equally near the search says that it does not know", "[mesh]") {
    Soup fan;
    fan.positions.push_back(Vec3(0));
    constexpr uint32_t sides = 20;
    for (uint32_t i = 0; i < sides; ++i) {
        const double angle = 2 * M_PI * i / sides;
        fan.positions.emplace_back(std::cos(angle), std::sin(angle), -1);
        fan.triangles.push_back({0, 1 + i, 1 + (i + 1) % sides});
    }
    const SearchTree tree(fan.positions, fan.triangles);
    const Missed result = missed(tree, {Vec3(0, 0, 1), Vec3(0.5, 0.1, -0.3)});
    CHECK(result.unknown == 1);
    CHECK(result.points == 0);
}

TEST_CASE("a device that fails is warned of once and not asked again", "[mesh]") {
    const Mesh mesh = make_sample("cube", 8);
    const NarrowTree tree = SearchTree(mesh.positions, mesh.triangles).narrowed();
    const std::vector<glm::vec3> points(3, glm::vec3(0.1F));
    std::vector<NearSlots> found(points.size());
    for (int calls = 0; calls < 4; ++calls) {
        FailingSearchDevice device(calls);
        Log log;
        LastingSearchDevice lasting(device, log);
        const auto search = lasting.put(tree);
        REQUIRE((search != nullptr) == (calls > 0));
        for (int i = 1; search && i < 6; ++i) {
            CHECK(search->find(points, found) == (i < calls));
        }
        REQUIRE(log.warnings.size() == 1);
        CHECK(log.warnings.front() == "the device was lost; distance fields are baked on the CPU");
        CHECK(lasting.put(tree) == nullptr);
    }
}

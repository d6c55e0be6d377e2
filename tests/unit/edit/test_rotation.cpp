#include "engine/edit/rotation.h"

#include <catch2/catch.hpp>
#include <limits>
#include <random>

using namespace anvil;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

double distance(const Vec3& a, const Vec3& b) {
    return glm::length(a - b);
}

Vec3 rotated(const Vec3& p, const Vec3& origin, const Vec3& axis, double degrees) {
    return Rotation(origin, axis).turned(p, glm::radians(degrees));
}

/// In degrees.
double angle_to_reach(const Vec3& p, const Vec3& origin, const Vec3& axis, const Vec3& target) {
    return glm::degrees(Rotation(origin, axis).angle_to_reach(p, target));
}

} // namespace

TEST_CASE("a quarter turn about y takes z to x") {
    CHECK(distance(rotated({0, 0, 1}, {0, 0, 0}, {0, 2, 0}, 90), {1, 0, 0}) <= 4 * eps);
    CHECK(distance(rotated({5, 1, 1}, {5, 0, 0}, {0, 1, 0}, 90), {6, 1, 0}) <= 16 * eps);
}

TEST_CASE("rotation keeps the distance to the axis and the place along it, whole turns change nothing") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-2, 2);
    for (int i = 0; i < 500; ++i) {
        const Vec3 p(number(random), number(random), number(random));
        const Vec3 origin(number(random), number(random), number(random));
        const Vec3 axis = glm::normalize(Vec3(number(random), number(random), number(random)));
        const double degrees = 360 * number(random);
        const Vec3 q = rotated(p, origin, axis, degrees);
        // Lengths of at most 7, some ten roundings.
        CHECK(std::abs(distance(q, origin) - distance(p, origin)) <= 100 * eps);
        CHECK(std::abs(glm::dot(q - p, axis)) <= 100 * eps);
        // 720 degrees in radians is off by at most 8 eps.
        CHECK(distance(rotated(p, origin, axis, 720), p) <= 200 * eps);
        CHECK(distance(rotated(q, origin, axis, -degrees), p) <= 200 * eps);
    }
}

TEST_CASE("no rotation keeps every bit, and points on the axis stay") {
    const Vec3 p(0.1, 0.2, 0.3);
    CHECK(rotated(p, {1, 2, 3}, {1, 1, 1}, 0) == p);
    CHECK(rotated({0, 5, 0}, {0, 1, 0}, {0, 1, 0}, 77) == Vec3(0, 5, 0));
}

TEST_CASE("the angle to reach undoes a rotation of less than half a turn") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-2, 2);
    for (int i = 0; i < 500; ++i) {
        const Vec3 p(number(random), number(random), number(random));
        const Vec3 origin(number(random), number(random), number(random));
        const Vec3 axis(number(random), number(random), number(random));
        const double degrees = 89.9 * number(random);
        // Points close to the axis lose digits of their direction.
        CHECK(angle_to_reach(p, origin, axis, rotated(p, origin, axis, degrees)) ==
              Approx(degrees).margin(1e-9));
    }
}

TEST_CASE("the angle to reach brings the point nearer than any other angle") {
    const Vec3 p(1, 0.5, 0.25);
    const Vec3 origin(0.1, 0, 0);
    const Vec3 axis(0.2, 1, -0.3);
    const Vec3 target(-2, 3, 1);
    const double best = angle_to_reach(p, origin, axis, target);
    const double least = distance(rotated(p, origin, axis, best), target);
    for (int degrees = -180; degrees < 180; ++degrees) {
        CHECK(least <= distance(rotated(p, origin, axis, degrees), target) + 8 * eps);
    }
}

TEST_CASE("half a turn is +180 degrees and a point on the axis has nothing to turn") {
    CHECK(angle_to_reach({1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-3, 5, 0}) == 180);
    CHECK(angle_to_reach({1, 0, -0.0}, {0, 0, 0}, {0, -1, 0}, {-3, 5, 0}) == 180);
    CHECK(angle_to_reach({0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}) == 0);
    CHECK(angle_to_reach({1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 9, 0}) == 0);
}

TEST_CASE("angles do not depend on the scale of the scene") {
    const double exact = angle_to_reach({1, 2, 3}, {0, 0, 0}, {1, 1, 0}, {3, -2, 1});
    for (const double scale : {1e-200, 1e-30, 1e30, 1e200}) {
        CHECK(angle_to_reach(scale * Vec3(1, 2, 3), {0, 0, 0}, scale * Vec3(1, 1, 0),
                             scale * Vec3(3, -2, 1)) == Approx(exact).epsilon(1e-13));
    }
}

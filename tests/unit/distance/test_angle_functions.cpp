#include "engine/distance/angle_functions.h"
#include "engine/distance/unfold.h"

#include <catch2/catch.hpp>
#include <random>

using namespace anvil;

namespace {

/// Places above the x axis, on it and on its diagonals, at all scales that a mesh has.
std::vector<std::array<double, 2>> upper_places() {
    std::vector<std::array<double, 2>> places = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {1, 1}, {-1, 1}};
    std::mt19937 random(5);
    std::uniform_real_distribution<double> angle(0, 3.14159265358979), power(-12, 3);
    for (int i = 0; i < 20000; ++i) {
        const double a = angle(random), size = std::pow(10, power(random)),
                     flat = std::pow(10, power(random));
        places.push_back({size * std::cos(a), size * std::sin(a)});
        places.push_back({size * std::cos(a), std::min(1.0, flat) * size * std::sin(a)});
    }
    return places;
}

} // namespace

TEST_CASE("angles over the half turn err by no more than they say, in double and in float") {
    double worst = 0, worst_float = 0;
    for (const auto& [x, y] : upper_places()) {
        worst = std::max(worst, std::abs(half_turn_angle(x, y) - std::atan2(y, x)));
        const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
        const double expected = std::atan2(static_cast<double>(fy), static_cast<double>(fx));
        worst_float =
            std::max(worst_float, std::abs(static_cast<double>(half_turn_angle(fx, fy)) - expected));
    }
    CHECK(worst < 1e-12);
    CHECK(worst_float < 4e-7);
}

TEST_CASE("sines and cosines over the half turn err by no more than they say") {
    double worst = 0;
    for (int i = 0; i <= 100000; ++i) {
        const float angle = 3.14159265F * static_cast<float>(i) / 100000;
        const SineCosine found = half_turn_sine_cosine(angle);
        const auto exact = static_cast<double>(angle);
        worst = std::max({worst, std::abs(static_cast<double>(found.sine) - std::sin(exact)),
                          std::abs(static_cast<double>(found.cosine) - std::cos(exact))});
    }
    CHECK(worst < 2.5e-7);
}

TEST_CASE(
    "the area of a triangle keeps its digits on needles and does not depend on the order of its sides") {
    // Sides 1, 1, e: 16 A^2 = e^2 (4 - e^2).
    for (const double e : {1.0, 1e-3, 1e-8, 1e-15}) {
        const double expected = e * e * (4 - e * e);
        CHECK(sixteen_area_squared(1, 1, e) == Approx(expected).epsilon(1e-14));
        CHECK(sixteen_area_squared(1, e, 1) == sixteen_area_squared(1, 1, e));
        CHECK(sixteen_area_squared(e, 1, 1) == sixteen_area_squared(1, 1, e));
    }
    std::mt19937 random(6);
    std::uniform_real_distribution<double> length(0.5, 1);
    for (int i = 0; i < 1000; ++i) {
        const double a = length(random), b = length(random), c = length(random);
        const double area = sixteen_area_squared(a, b, c);
        CHECK(sixteen_area_squared(b, c, a) == area);
        CHECK(sixteen_area_squared(c, a, b) == area);
        CHECK(sixteen_area_squared(c, b, a) == area);
    }
    CHECK(sixteen_area_squared(1, 2, 4) == 0);
}

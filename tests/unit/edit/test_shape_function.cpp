#include "engine/core/error.h"
#include "engine/edit/shape_function.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

using namespace anvil;
using Catch::Matchers::Contains;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

ShapeFunction preset(const std::string& name) {
    return ShapeFunction(preset_knots(name));
}

Knot free_knot(double t, double value) {
    return {t, value, std::nullopt, std::nullopt};
}

// A sampled lower bound of max |phi'|.
double steepest_chord(const ShapeFunction& phi) {
    double steepest = 0;
    const int n = 200000;
    for (int i = 0; i < n; ++i) {
        const double a = double(i) / n;
        const double b = double(i + 1) / n;
        steepest = std::max(steepest, std::abs(phi(b) - phi(a)) / (b - a));
    }
    return steepest;
}

} // namespace

TEST_CASE("the smooth shape is 1 - 3 t^2 + 2 t^3") {
    const ShapeFunction phi;
    REQUIRE(phi.segments().size() == 1);
    for (int i = 0; i <= 1000; ++i) {
        const double t = i / 1000.0;
        // Four roundings of terms of at most 3.
        CHECK(std::abs(phi(t) - (1 - 3 * t * t + 2 * t * t * t)) <= 16 * eps);
    }
    CHECK(phi.lipschitz() == Approx(1.5).epsilon(1e-14));
}

TEST_CASE("every preset passes through its knots, ends in 0 and stays 0 beyond the radius") {
    for (const std::string& name : preset_names()) {
        INFO(name);
        const ShapeFunction phi = preset(name);
        for (const Knot& knot : phi.knots()) {
            // The segment before a knot reaches it up to the rounding of t times its slope.
            CHECK(std::abs(phi(knot.t) - knot.value) <= 8 * eps * (1 + phi.lipschitz()));
        }
        CHECK(std::abs(phi(1)) <= 8 * eps * (1 + phi.lipschitz()));
        CHECK(phi(1 + eps) == 0);
        CHECK(phi(std::numeric_limits<double>::infinity()) == 0);
    }
}

TEST_CASE("the presets sphere, root, sharp and linear follow their formulas") {
    const struct {
        const char* name;
        double (*formula)(double);
        double tolerance;
    } cases[] = {{"sphere", [](double t) { return std::sqrt(1 - t * t); }, 0.03},
                 {"root", [](double t) { return 1 - std::sqrt(t); }, 0.015},
                 {"sharp", [](double t) { return (1 - t) * (1 - t); }, 8 * eps},
                 {"linear", [](double t) { return 1 - t; }, 8 * eps}};
    for (const auto& c : cases) {
        const ShapeFunction phi = preset(c.name);
        double worst = 0;
        for (int i = 0; i <= 10000; ++i) {
            worst = std::max(worst, std::abs(phi(i / 10000.0) - c.formula(i / 10000.0)));
        }
        INFO(c.name << " deviates by " << worst);
        CHECK(worst <= c.tolerance);
    }
}

TEST_CASE("plateau is 1 up to nine tenths and constant up to 99.9 % of the radius") {
    const ShapeFunction plateau = preset("plateau");
    const ShapeFunction constant = preset("constant");
    for (int i = 0; i <= 900; ++i) {
        CHECK(plateau(i / 1000.0) == 1);
        CHECK(constant(i / 1000.0) == 1);
    }
    CHECK(plateau(0.95) == Approx(0.5).margin(1e-14));
    CHECK(constant(0.9995) == Approx(0.5).margin(1e-11));
}

TEST_CASE("the decreasing presets decrease and no preset leaves [-1, 1]") {
    for (const std::string& name : preset_names()) {
        INFO(name);
        const ShapeFunction phi = preset(name);
        CHECK(phi.max_magnitude() <= 1 + 8 * eps);
        if (name == "crater" || name == "wave" || name == "rim") {
            continue;
        }
        for (int i = 1; i <= 20000; ++i) {
            // Up to the rounding of the polynomial.
            CHECK(phi(i / 20000.0) <= phi((i - 1) / 20000.0) + 8 * eps * (1 + phi.lipschitz()));
        }
    }
}

TEST_CASE("the Lipschitz constant is a tight bound of every chord's slope") {
    for (const std::string& name : preset_names()) {
        INFO(name);
        const ShapeFunction phi = preset(name);
        const double chord = steepest_chord(phi);
        // A chord carries the rounding of two values over its length 1/200000.
        CHECK(chord <= phi.lipschitz() * (1 + 1e-6) + 1e-9);
        CHECK(chord >= phi.lipschitz() * 0.999);
    }
}

TEST_CASE("a steep inflection inside a segment counts in the Lipschitz constant") {
    // Flat at both ends: the steepest slope, 1.5 times the secant, is in the middle.
    const ShapeFunction phi({{0, 1, 0, 0}, {0.5, 0, 0, 0}, {1, 0, 0, 0}});
    CHECK(phi.lipschitz() == Approx(3).epsilon(1e-14));
}

TEST_CASE("the magnitude counts overshoot between knots") {
    // 4 t (1 - t): zero at both knots, 1 in the middle.
    const ShapeFunction phi({{0, 0, 4, 4}, {1, 0, -4, -4}});
    CHECK(phi.max_magnitude() == Approx(1).epsilon(1e-14));
    CHECK(phi(0.5) == Approx(1).epsilon(1e-14));
}

TEST_CASE("knots without slopes never overshoot their neighbours") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> value(-2, 2);
    std::uniform_real_distribution<double> gap(0.01, 1);
    for (int round = 0; round < 200; ++round) {
        std::vector<Knot> knots{free_knot(0, value(random))};
        for (int i = 0; i < 8; ++i) {
            knots.push_back(free_knot(knots.back().t + gap(random), value(random)));
        }
        const double scale = knots.back().t;
        for (Knot& knot : knots) {
            knot.t /= scale;
        }
        knots.back() = free_knot(1, 0);
        const ShapeFunction phi(knots);
        for (size_t k = 0; k + 1 < knots.size(); ++k) {
            const auto [low, high] = std::minmax(knots[k].value, knots[k + 1].value);
            for (int i = 0; i <= 50; ++i) {
                const double v = phi(knots[k].t + (knots[k + 1].t - knots[k].t) * i / 50);
                CHECK(v >= low - 1e-13);
                CHECK(v <= high + 1e-13);
            }
        }
    }
}

TEST_CASE("free slopes reproduce a straight line") {
    const ShapeFunction phi({free_knot(0, 1), free_knot(0.3, 0.7), free_knot(0.55, 0.45), free_knot(1, 0)});
    for (int i = 0; i <= 100; ++i) {
        CHECK(std::abs(phi(i / 100.0) - (1 - i / 100.0)) <= 16 * eps);
    }
}

TEST_CASE("left and right slopes that differ make a kink") {
    const ShapeFunction phi({{0, 1, {}, 0}, {0.5, 0.4, -2, 0}, {1, 0, 0, {}}});
    const double h = 1e-7;
    CHECK((phi(0.5) - phi(0.5 - h)) / h == Approx(-2).margin(1e-5));
    CHECK((phi(0.5 + h) - phi(0.5)) / h == Approx(0).margin(1e-5));
}

TEST_CASE("before its first knot a shape has the first value, after its last knot it is 0") {
    const ShapeFunction phi({{0.25, 0.8, 0, 0}, {0.75, 0, 0, 0}});
    REQUIRE(phi.segments().size() == 3);
    CHECK(phi.segments().front().begin == 0);
    CHECK(phi(0) == 0.8);
    CHECK(phi(-1) == 0.8);
    CHECK(phi(0.2) == 0.8);
    CHECK(phi(0.25) == 0.8);
    CHECK(phi(0.75) == 0);
    CHECK(phi(0.9) == 0);
    CHECK(phi(1) == 0);
}

TEST_CASE("256 knots are a shape and 257 are not") {
    std::vector<Knot> knots;
    for (int i = 0; i < 256; ++i) {
        knots.push_back(free_knot(i / 255.0, 1 - i / 255.0));
    }
    CHECK(ShapeFunction(knots)(0.4) == Approx(0.6).epsilon(1e-13));
    knots.insert(knots.begin() + 1, free_knot(0.001, 0.999));
    CHECK_THROWS_AS(ShapeFunction(knots), InputError);
}

TEST_CASE("bad knots are refused with their place and the reason") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    const Knot end{1, 0, 0, 0};
    const struct {
        std::vector<Knot> knots;
        const char* place;
        const char* reason;
    } cases[] = {
        {{}, "knots", "2 to 256"},
        {{end}, "knots", "2 to 256"},
        {{{0, 1, 0, 0}, {0.5, 1, 0, 0}, {0.5, 0, 0, 0}, end}, "knots[2].t", "must increase"},
        {{{0.5, 1, 0, 0}, {0.2, 1, 0, 0}, end}, "knots[1].t", "must increase"},
        {{{0.5, 1, 0, 0}, {0.5 + 1e-9, 0, 0, 0}, end}, "knots[1].t", "jump"},
        {{{-0.1, 1, 0, 0}, end}, "knots[0].t", "[0, 1]"},
        {{{0, 1, 0, 0}, {1.5, 0, 0, 0}}, "knots[1].t", "[0, 1]"},
        {{{nan, 1, 0, 0}, end}, "knots[0].t", "[0, 1]"},
        {{{0, nan, 0, 0}, end}, "knots[0].value", "number"},
        {{{0, inf, 0, 0}, end}, "knots[0].value", "number"},
        {{{0, 1, 0, nan}, end}, "knots[0].right", "slope"},
        {{{0, 1, 0, 0}, {1, 0, -inf, 0}}, "knots[1].left", "slope"},
        {{{0, 1, 0, 0}, {1, 0.5, 0, 0}}, "knots[1].value", "must be 0"},
        {{{0, 1, 0, 0}, {0.7, 0.5, 0, 0}}, "knots[1].value", "must be 0"},
    };
    for (const auto& c : cases) {
        CHECK_THROWS_WITH(ShapeFunction(c.knots), Contains(c.place) && Contains(c.reason));
        CHECK_THROWS_AS(ShapeFunction(c.knots), InputError);
    }
}

TEST_CASE("an unknown preset is refused with the names of the known ones") {
    for (const std::string& name : preset_names()) {
        CHECK_THROWS_WITH(preset_knots("smoth"), Contains("smoth") && Contains(name));
    }
}

TEST_CASE("segments say the same as the function") {
    for (const std::string& name : preset_names()) {
        const ShapeFunction phi = preset(name);
        const auto& segments = phi.segments();
        CHECK(segments.front().begin == 0);
        for (int i = 0; i <= 997; ++i) {
            const double t = i / 997.0;
            const ShapeSegmentD* holds = nullptr;
            for (const ShapeSegmentD& segment : segments) {
                holds = segment.begin <= t ? &segment : holds;
            }
            const double s = t - holds->begin;
            CHECK(phi(t) == holds->c0 + s * (holds->c1 + s * (holds->c2 + s * holds->c3)));
        }
    }
}

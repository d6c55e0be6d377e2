#include "engine/occluder/exact_distance.h"
#include "engine/occluder/shape_nodes.h"
#include "tests/support/contact_scene.h"

#include <catch2/catch.hpp>
#include <functional>

using namespace anvil;
using test::random_in;

namespace {

/// A primitive beside what is known of it without its distance formula: a sampler of its surface and an
/// inside test.
struct Case {
    std::string name;
    OccluderShape shape;
    std::function<Vec3(std::mt19937&)> on_surface;
    std::function<bool(const Vec3&)> inside;
};

double radial(const Vec3& p) {
    return std::hypot(p.x, p.z);
}

Vec3 around(double r, double y, double angle) {
    return {r * std::cos(angle), y, r * std::sin(angle)};
}

double uniform(std::mt19937& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 on_box(std::mt19937& random, const Vec3& half) {
    Vec3 p = random_in(random, -half, half);
    const int side = static_cast<int>(random() % 3);
    p[side] = random() % 2 == 0 ? half[side] : -half[side];
    return p;
}

std::vector<Case> cases() {
    const double pi = 3.14159265358979323846;
    return {
        {"sphere", SphereShape{0.7}, [](auto& r) { return 0.7 * test::random_direction(r); },
         [](const Vec3& p) { return glm::length(p) < 0.7; }},
        {"box", BoxShape{{0.5, 0.3, 0.8}, 0},
         [](auto& r) {
             return on_box(r, {0.5, 0.3, 0.8});
         },
         [](const Vec3& p) { return std::abs(p.x) < 0.5 && std::abs(p.y) < 0.3 && std::abs(p.z) < 0.8; }},
        {"rounded box", BoxShape{{0.5, 0.3, 0.8}, 0.1},
         [](auto& r) { // inner box grown by the rounding
             const Vec3 inner(0.4, 0.2, 0.7);
             for (;;) {
                 const Vec3 p = random_in(r, -2.0 * inner, 2.0 * inner);
                 const Vec3 foot = glm::clamp(p, -inner, inner);
                 if (p != foot) {
                     return foot + 0.1 * (p - foot) / glm::length(p - foot);
                 }
             }
         },
         [](const Vec3& p) {
             const Vec3 inner(0.4, 0.2, 0.7);
             return glm::length(p - glm::clamp(p, -inner, inner)) < 0.1;
         }},
        {"cylinder", CylinderShape{0.4, 1.2},
         [pi](auto& r) {
             const double angle = uniform(r, 0, 2 * pi);
             return r() % 2 == 0
                        ? around(0.4, uniform(r, -0.6, 0.6), angle)
                        : around(0.4 * std::sqrt(uniform(r, 0, 1)), r() % 2 == 0 ? 0.6 : -0.6, angle);
         },
         [](const Vec3& p) { return radial(p) < 0.4 && std::abs(p.y) < 0.6; }},
        {"capsule", CapsuleShape{0.3, 1.0},
         [pi](auto& r) {
             if (r() % 2 == 0) {
                 return around(0.3, uniform(r, -0.5, 0.5), uniform(r, 0, 2 * pi));
             }
             const Vec3 u = 0.3 * test::random_direction(r);
             return u + Vec3(0, u.y < 0 ? -0.5 : 0.5, 0);
         },
         [](const Vec3& p) { return glm::length(p - Vec3(0, std::clamp(p.y, -0.5, 0.5), 0)) < 0.3; }},
        {"cone", ConeShape{0.5, 1.0},
         [pi](auto& r) {
             const double angle = uniform(r, 0, 2 * pi);
             const double s = std::sqrt(uniform(r, 0, 1));
             return r() % 2 == 0 ? around(0.5 * s, 0.5 - s, angle) : around(0.5 * s, -0.5, angle);
         },
         [](const Vec3& p) { return p.y > -0.5 && radial(p) < 0.5 * (0.5 - p.y); }},
        {"torus", TorusShape{0.6, 0.2},
         [pi](auto& r) {
             const double a = uniform(r, 0, 2 * pi);
             return around(0.6 + 0.2 * std::cos(a), 0.2 * std::sin(a), uniform(r, 0, 2 * pi));
         },
         [](const Vec3& p) { return std::hypot(radial(p) - 0.6, p.y) < 0.2; }},
    };
}

} // namespace

TEST_CASE("the distance of every primitive is that to its closest surface point") {
    for (const Case& c : cases()) {
        INFO(c.name);
        std::mt19937 random(7);
        const auto exact = formula_distance(shape_nodes(c.shape));
        std::vector<Vec3> surface;
        for (int i = 0; i < 20000; ++i) {
            surface.push_back(c.on_surface(random));
        }
        for (const Vec3& s : surface) {
            REQUIRE(std::abs(exact->at(s).distance) < 1e-12);
        }
        for (int i = 0; i < 300; ++i) {
            const Vec3 p = random_in(random, Vec3(-1.2), Vec3(1.2));
            const SignedDistance d = exact->at(p);
            double nearest = infinity;
            for (const Vec3& s : surface) {
                nearest = std::min(nearest, glm::length(p - s));
            }
            CHECK((d.distance < 0) == c.inside(p));
            CHECK(std::abs(d.distance) <= nearest + 1e-12);
            CHECK(nearest - std::abs(d.distance) < 0.02); // the samples' spacing
            CHECK(std::abs(glm::length(d.normal) - 1) < 1e-12);
            CHECK(std::abs(exact->at(p - d.distance * d.normal).distance) < 1e-12);
        }
    }
}

TEST_CASE("a primitive's normal is the gradient of its distance") {
    for (const Case& c : cases()) {
        INFO(c.name);
        std::mt19937 random(8);
        const auto exact = formula_distance(shape_nodes(c.shape));
        int checked = 0;
        for (int i = 0; i < 300; ++i) {
            const Vec3 p = random_in(random, Vec3(-1.2), Vec3(1.2));
            const double e = 1e-6;
            Vec3 gradient(0);
            for (int k = 0; k < 3; ++k) {
                Vec3 step(0);
                step[k] = e;
                gradient[k] = (exact->at(p + step).distance - exact->at(p - step).distance) / (2 * e);
            }
            if (std::abs(glm::length(gradient) - 1) < 1e-6) { // elsewhere p is on the medial axis
                ++checked;
                CHECK(glm::length(gradient - exact->at(p).normal) < 1e-5);
            }
        }
        CHECK(checked > 280);
    }
}

TEST_CASE("distances are numbers at the centre, on the axis and at the apex") {
    for (const Case& c : cases()) {
        const auto exact = formula_distance(shape_nodes(c.shape));
        for (const Vec3& p : {Vec3(0), Vec3(0, 0.5, 0), Vec3(0, -0.5, 0), Vec3(0, 2, 0), Vec3(0.6, 0, 0)}) {
            INFO(c.name);
            const SignedDistance d = exact->at(p);
            CHECK(std::isfinite(d.distance));
            CHECK(std::abs(glm::length(d.normal) - 1) < 1e-12);
        }
    }
}

TEST_CASE("a plane is on the inner side of its normal, whatever the normal's length") {
    const auto exact = formula_distance(shape_nodes(OccluderShape{PlaneShape{{0, 3, 4}, 2}}));
    CHECK(exact->at(Vec3(0, 0, 0)).distance == Approx(-2));
    CHECK(exact->at(Vec3(5, 0.6 * 7, 0.8 * 7)).distance == Approx(5));
    CHECK(!is_finite(exact->bounds().high));
}

TEST_CASE("Boolean operators keep the sign of set operations and a bound of the distance") {
    const CsgShape lens{CsgOperation::intersect,
                        {{"", SphereShape{1}, {{0.5, 0, 0}}}, {"", SphereShape{1}, {{-0.5, 0, 0}}}}};
    const CsgShape pair{CsgOperation::unite, {{"", SphereShape{1}, {{0.5, 0, 0}}}, {"", lens, {{0, 3, 0}}}}};
    const CsgShape bitten{CsgOperation::subtract,
                          {{"", BoxShape{Vec3(1), 0}, {}}, {"", SphereShape{0.8}, {{1, 0, 0}}}}};
    const auto in_ball = [](const Vec3& p, const Vec3& c, double r) { return glm::length(p - c) < r; };
    const auto in_lens = [&](const Vec3& p) {
        return in_ball(p, {0.5, 0, 0}, 1) && in_ball(p, {-0.5, 0, 0}, 1);
    };
    std::mt19937 random(9);
    for (int i = 0; i < 3000; ++i) {
        const Vec3 p = random_in(random, {-2, -2, -2}, {2, 4, 2});
        CHECK((formula_distance(shape_nodes(OccluderShape{lens}))->at(p).distance < 0) == in_lens(p));
        CHECK((formula_distance(shape_nodes(OccluderShape{pair}))->at(p).distance < 0) ==
              (in_ball(p, {0.5, 0, 0}, 1) || in_lens(p - Vec3(0, 3, 0))));
        const bool in_box = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 1;
        CHECK((formula_distance(shape_nodes(OccluderShape{bitten}))->at(p).distance < 0) ==
              (in_box && !in_ball(p, {1, 0, 0}, 0.8)));
    }
}

TEST_CASE("a placed and scaled part is the shape at its place") {
    const Transform place{{1, 2, 3}, {0, 0, 2}, 90, 0.5};
    const CsgShape one{CsgOperation::unite, {{"", BoxShape{{1, 0.2, 0.4}, 0}, place}}};
    const auto exact = formula_distance(shape_nodes(OccluderShape{one}));
    // Half size, the long axis along y after the quarter turn.
    CHECK(exact->at(Vec3(1, 2, 3)).distance == Approx(-0.1));
    CHECK(exact->at(Vec3(1, 2.5, 3)).distance == Approx(0).margin(1e-15));
    CHECK(exact->at(Vec3(2, 2, 3)).distance == Approx(0.9));
    CHECK(exact->bounds().high.y == Approx(2.5));
    CHECK(exact->bounds().high.x == Approx(1.1));
}

TEST_CASE("a re-distanced solid has the true distance where the operators only bound it") {
    // A box with a corner region cut off by intersection: outside the edge the bound is too small.
    const CsgShape wedge{CsgOperation::intersect,
                         {{"", BoxShape{Vec3(1), 0}, {}}, {"", BoxShape{Vec3(1), 0}, {{0.5, 0.5, 0}}}}};
    // The solid is the box [-0.5, 1]^2 x [-1, 1].
    const auto exact = redistanced(formula_distance(shape_nodes(OccluderShape{wedge})), 64);
    const auto truth = formula_distance(shape_nodes(OccluderShape{
        CsgShape{CsgOperation::unite, {{"", {BoxShape{{0.75, 0.75, 1}, 0}}, {{0.25, 0.25, 0}}}}}}));
    std::mt19937 random(10);
    double worst = 0;
    double bound_error = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p = random_in(random, Vec3(-2), Vec3(2));
        worst = std::max(worst, std::abs(exact->at(p).distance - truth->at(p).distance));
        bound_error = std::max(bound_error,
                               std::abs(formula_distance(shape_nodes(OccluderShape{wedge}))->at(p).distance -
                                        truth->at(p).distance));
    }
    CHECK(bound_error > 0.1);
    CHECK(worst < 2e-3); // a tenth of a polygonization cell
}

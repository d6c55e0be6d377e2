#include "engine/core/error.h"
#include "engine/distance/anchor_blend.h"
#include "engine/distance/gradient.h"
#include "tests/unit/distance/surfaces.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::surfaces;

namespace {

double smooth(std::vector<double> distances, double width) {
    return smooth_minimum(distances, width);
}

DistanceField anchored(const GeodesicSolver& solver, const std::vector<SurfacePoint>& points, double radius,
                       double width) {
    std::vector<DistanceSources> anchors;
    for (const SurfacePoint& point : points) {
        anchors.emplace_back().points.push_back(point);
    }
    return anchor_distances(anchors, radius, width, [&](const DistanceSources& sources, double reach) {
        return solver.solve(sources, reach);
    });
}

} // namespace

TEST_CASE("the smooth minimum lies between zero and the minimum, and meets its bound") {
    std::mt19937 random(4);
    const auto uniform = [&] { return random() / 4294967296.0; };
    for (int i = 0; i < 20000; ++i) {
        std::vector<double> d(1 + random() % 6);
        for (double& x : d) {
            x = std::pow(10, 6 * uniform() - 4);
        }
        if (random() % 10 == 0) {
            d[0] = infinity;
        }
        const double width = std::pow(10, 5 * uniform() - 4);
        const double least = *std::min_element(d.begin(), d.end());
        const double found = smooth(d, width);
        const double count = static_cast<double>(d.size());
        REQUIRE(found >= 0);
        REQUIRE(found <= least);
        // One rounding of `least` at most beyond the bound.
        REQUIRE((std::isinf(least) || least - found <= width * std::log(count) + 4e-16 * least));
        std::reverse(d.begin(), d.end());
        REQUIRE(smooth(d, width) == Approx(found).epsilon(1e-12));
    }
    CHECK(smooth({0, 0.3, 2}, 0.5) == 0);
    CHECK(smooth({infinity, infinity}, 0.5) == infinity);
    CHECK(smooth({0.7, 0.8}, 0) == 0.7);
    CHECK(smooth({0.7, 0.8}, 1e-9) == Approx(0.7).epsilon(1e-9));
}

TEST_CASE("the smooth minimum has no kink where two distances cross") {
    // Slopes left and right of the crossing: those of the minimum differ by 2.
    const double step = 1e-6;
    const auto at = [](double x) { return smooth({1 + x, 1 - x}, 0.3); };
    const double left = (at(-step) - at(-2 * step)) / step, right = (at(2 * step) - at(step)) / step;
    CHECK(std::abs(right - left) < 1e-4);
    const auto three = [](double x) { return smooth({1 + x, 1 - x, 1 + 0.2 * x}, 0.3); };
    CHECK((three(step) - three(0)) / step == Approx((three(0) - three(-step)) / step).margin(1e-4));
}

TEST_CASE("blended anchors give zero on each, at most the nearest, and the nearest as the width falls") {
    const Mesh mesh = bumps(20, 0.1);
    const GeodesicSolver solver(mesh, mesh.positions);
    const std::vector<SurfacePoint> anchors = {
        vertex_source(60), vertex_source(300), {500, {0.3, 0.3, 0.4}, no_index}};
    const size_t n = mesh.vertex_count();
    const std::vector<double> nearest = anchored(solver, anchors, infinity, 0).dense(n);
    const std::vector<double> blended = anchored(solver, anchors, infinity, 0.1).dense(n);
    const std::vector<double> narrow = anchored(solver, anchors, infinity, 1e-6).dense(n);
    CHECK(blended[60] == 0);
    CHECK(blended[300] == 0);
    for (size_t v = 0; v < n; ++v) {
        CHECK(blended[v] <= nearest[v] + 1e-12);
        CHECK(blended[v] >= nearest[v] - 0.1 * std::log(3.0) - 1e-12);
        CHECK(narrow[v] == Approx(nearest[v]).margin(2e-6));
    }
    const std::vector<SurfacePoint> other = {anchors[2], anchors[1], anchors[0]};
    CHECK(worst_relative(anchored(solver, other, infinity, 0.1).dense(n), blended, 1e-3) < 1e-12);
}

TEST_CASE("a bounded blend gives the numbers of the unbounded one within the radius") {
    const Mesh mesh = bumps(20, 0.1);
    const GeodesicSolver solver(mesh, mesh.positions);
    const std::vector<SurfacePoint> anchors = {vertex_source(60), vertex_source(300)};
    const size_t n = mesh.vertex_count();
    const std::vector<double> all = anchored(solver, anchors, infinity, 0.02).dense(n);
    const std::vector<double> some = anchored(solver, anchors, 0.3, 0.02).dense(n);
    for (size_t v = 0; v < n; ++v) {
        // What lies 20 widths beyond the nearest is left out: 2e-9 of the width.
        CHECK((all[v] <= 0.3 ? std::abs(some[v] - all[v]) < 1e-9 : std::isinf(some[v])));
    }
    CHECK_THROWS_AS(anchored(solver, anchors, 1, -0.1), InputError);
    CHECK_THROWS_AS(anchored(solver, anchors, 1, NAN), InputError);
    CHECK_THROWS_AS(anchored(solver, anchors, -1, 0.1), InputError);
}

TEST_CASE("the gradient of a distance field has length one and points away from the source") {
    const Mesh mesh = plane(40, 40, 1, 1, 0.2);
    const SurfacePoint source = vertex_source(20 * 41 + 20);
    const std::vector<double> found = solve(mesh, {source}, infinity, DistanceMethod::exact);
    const std::vector<Vec3> gradients = face_gradients(mesh.triangles, mesh.positions, found);
    for (size_t i = 0; i < gradients.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        const Vec3 away =
            (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0 - place(mesh, source);
        // The field bends by 1 / distance over a triangle of some 0.05.
        if (glm::length(away) > 0.2) {
            CHECK(glm::length(gradients[i] - glm::normalize(away)) < 0.05 / glm::length(away));
        }
    }
}

TEST_CASE("gradients are exact for linear values at any scale, and zero where there is none") {
    const Vec3 slope(0.3, -2, 0.7);
    for (const double scale : {1e-200, 1.0, 1e200}) {
        const std::vector<Vec3> p = {Vec3(0, 0, 0), Vec3(1, 0.2, 0) * scale, Vec3(0.1, 1, 0.4) * scale,
                                     Vec3(2, 0.4, 0) * scale};
        std::vector<double> values;
        for (const Vec3& v : p) {
            values.push_back(glm::dot(slope, v));
        }
        const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 1, 3}, {0, 0, 2}};
        const std::vector<Vec3> found = face_gradients(triangles, p, values);
        const Vec3 normal = glm::normalize(glm::cross(p[1] / scale, p[2] / scale));
        CHECK(glm::length(found[0] - (slope - glm::dot(slope, normal) * normal)) < 1e-14);
        CHECK(found[1] == Vec3(0));
        CHECK(found[2] == Vec3(0));
        values[2] = infinity;
        CHECK(face_gradients(triangles, p, values)[0] == Vec3(0));
    }
}

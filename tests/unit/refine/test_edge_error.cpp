#include "engine/distance/anchor_blend.h"
#include "engine/refine/edge_error.h"

#include <catch2/catch.hpp>
#include <random>

using namespace anvil;

namespace {

/// The spec's virtual source, written out; the other forms only where no point has such distances.
double truth(double d0, double d1, double length, double s) {
    const double x = (d0 * d0 - d1 * d1 + length * length) / (2 * length);
    const double y = std::sqrt(std::max(0.0, d0 * d0 - x * x));
    return std::hypot(s - x, y);
}

HandleField handle_of(const std::string& preset, double radius,
                      const std::vector<std::pair<double, double>>& anchors, double blend = 0) {
    HandleField handle{ShapeFunction(preset_knots(preset)), radius, blend, {}};
    for (const auto& [d0, d1] : anchors) {
        handle.anchors.push_back({{d0, d1}, SourceKind::point, std::nullopt});
    }
    return handle;
}

double sampled_gamma(const HandleField& handle, double length, double s) {
    std::vector<double> each;
    for (const AnchorField& anchor : handle.anchors) {
        each.push_back(truth(anchor.distances[0], anchor.distances[1], length, s));
    }
    return smooth_minimum(each, handle.blend);
}

double sampled_error(const HandleField& handle, double length, double s) {
    const double start = handle.shape(sampled_gamma(handle, length, 0) / handle.radius);
    const double end = handle.shape(sampled_gamma(handle, length, length) / handle.radius);
    return handle.shape(sampled_gamma(handle, length, s) / handle.radius) -
           (start + (end - start) * s / length);
}

/// Largest error to one side plus that to the other.
double densest_error(const HandleField& handle, double length) {
    double above = 0;
    double below = 0;
    for (int i = 1; i < 4000; ++i) {
        const double error = sampled_error(handle, length, length * i / 4000);
        above = std::max(above, error);
        below = std::min(below, error);
    }
    return above - below;
}

/// Distances of both ends of an edge of length 1 from a random point of the plane near it.
std::pair<double, double> random_source(std::mt19937& random) {
    std::uniform_real_distribution<double> along(-1.5, 2.5);
    std::uniform_real_distribution<double> exponent(-4, 0.3);
    const double x = along(random);
    const double y = std::pow(10.0, exponent(random));
    return {std::hypot(x, y), std::hypot(1 - x, y)};
}

} // namespace

TEST_CASE("Along an edge the distance is that from the point with the ends' distances") {
    std::mt19937 random(1);
    for (int trial = 0; trial < 500; ++trial) {
        const auto [d0, d1] = random_source(random);
        const EdgeDistance distance(d0, d1, 1);
        for (const double s : {0.0, 0.1, 0.37, 0.5, 0.93, 1.0}) {
            // Squares of distances up to 3 round by 1e-15; the root of a small one loses half of the digits.
            CHECK(distance.at(s) == Approx(truth(d0, d1, 1, s)).margin(1e-7));
        }
        CHECK(distance.at(0) == Approx(d0).epsilon(1e-14));
        CHECK(distance.at(1) == Approx(d1).epsilon(1e-14));
    }
}

TEST_CASE("Ends that no point of the plane fits keep their distances") {
    const EdgeDistance meeting(0.3, 0.2, 1);
    CHECK(meeting.at(0) == 0.3);
    CHECK(meeting.at(1) == 0.2);
    CHECK(meeting.turning_point() == Approx(0.45));
    CHECK(meeting.at(meeting.turning_point()) == Approx(0.75));
    const EdgeDistance steep(0.1, 2, 1);
    CHECK(steep.at(0) == 0.1);
    CHECK(steep.at(1) == 2);
    CHECK(steep.at(0.5) == Approx(1.05));
    const EdgeDistance front(1, 1, 1, SourceKind::line);
    CHECK(front.at(0.5) == 1);
}

TEST_CASE("Places at a distance are where the edge has that distance, and all of them") {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> level(0.01, 2);
    for (int trial = 0; trial < 2000; ++trial) {
        const auto [d0, d1] = random_source(random);
        const EdgeDistance distance(d0, d1, 1);
        const double wanted = level(random);
        int found = 0;
        for (const double s : distance.places_at(wanted)) {
            if (!std::isnan(s)) {
                ++found;
                CHECK(distance.at(s) == Approx(wanted).epsilon(1e-12));
            }
        }
        int changes = 0;
        for (int i = 0; i < 5000; ++i) {
            changes += (distance.at(i / 5000.0) > wanted) != (distance.at((i + 1) / 5000.0) > wanted);
        }
        // Two places closer than a sample are seen by the formula alone.
        CHECK((found == changes || (found == 2 && changes == 0)));
    }
}

TEST_CASE("The worst place of an edge is that of dense sampling, for every preset") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> radius(0.1, 3);
    for (const std::string& preset : preset_names()) {
        for (int trial = 0; trial < 100; ++trial) {
            const HandleField handle = handle_of(preset, radius(random), {random_source(random)});
            const double sampled = densest_error(handle, 1);
            const double enough = 1e-3;
            EdgeMeasure measure(handle);
            const EdgeError found = measure.worst({0, 1, 1}, enough);
            INFO(preset << " trial " << trial << " R " << handle.radius << " d "
                        << handle.anchors[0].distances[0] << " " << handle.anchors[0].distances[1]);
            // Arcs below the tolerance are not climbed to their top.
            CHECK(found.error >= (sampled > enough ? 0.99 : 0.8) * sampled - 1e-12);
            if (found.place > 0) {
                // Samples 1/4000 apart miss a kink by at most its slopes times that.
                const double missed = 4 * handle.shape.lipschitz() / handle.radius / 4000;
                CHECK(found.error <= sampled + missed + 1e-12);
                const double at_place = std::abs(sampled_error(handle, 1, found.place));
                CHECK(at_place >= 0.5 * found.error - 1e-6);
                CHECK(at_place <= found.error + 1e-6);
            } else {
                CHECK(found.error <= enough);
            }
        }
    }
}

TEST_CASE("Several anchors and blends are measured where they cross") {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> radius(0.3, 3);
    std::uniform_real_distribution<double> width(0.0, 0.3);
    for (const char* preset : {"smooth", "linear", "plateau", "crater"}) {
        for (int trial = 0; trial < 150; ++trial) {
            const double blend = trial % 2 == 0 ? 0 : width(random);
            const HandleField handle =
                handle_of(preset, radius(random),
                          {random_source(random), random_source(random), random_source(random)}, blend);
            const double sampled = densest_error(handle, 1);
            EdgeMeasure measure(handle);
            const EdgeError found = measure.worst({0, 1, 1}, 1e-3);
            INFO(preset << " trial " << trial << " blend " << blend << " found " << found.error);
            CHECK(found.error >= (sampled > 1e-3 ? 0.98 : 0.8) * sampled - 1e-12);
            if (found.place > 0) {
                CHECK(std::abs(sampled_error(handle, 1, found.place)) >= 0.5 * found.error - 1e-6);
            }
        }
    }
}

TEST_CASE("A kink on an edge is found to rounding and named") {
    // A cone of radius 1 from a source on the edge's line, 0.4 before it: the rim lies at 0.6.
    const HandleField handle = handle_of("linear", 1, {{0.4, 1.4}});
    EdgeMeasure measure(handle);
    const EdgeError found = measure.worst({0, 1, 1}, 1e-3);
    CHECK(found.place == Approx(0.6).epsilon(1e-14));
    CHECK(found.error == Approx(0.6 * 0.4).epsilon(1e-12));
    REQUIRE(found.level != no_index);
    CHECK(measure.levels()[found.level].distance == 1);
    REQUIRE(measure.crossings({0, 1, 1}, found.level).size() == 1);
    CHECK(measure.crossings({0, 1, 1}, found.level)[0] == found.place);
}

TEST_CASE("A bump in the middle of an edge whose ends have the same distance is seen") {
    // Eq. 18 divides by t1 - t0 = 0 here.
    const HandleField handle = handle_of("smooth", 1, {{1.1, 1.1}});
    EdgeMeasure measure(handle);
    const EdgeError found = measure.worst({0, 1, 2}, 1e-3);
    CHECK(found.place == Approx(0.5).margin(1e-6));
    CHECK(found.error == Approx(handle.shape(std::sqrt(1.1 * 1.1 - 1))).epsilon(1e-9));
}

TEST_CASE("Edges beyond the radius have no error") {
    const HandleField handle = handle_of("linear", 1, {{2, 2.5}});
    EdgeMeasure measure(handle);
    CHECK(measure.worst({0, 1, 1}, 1e-3).error == 0);
    const HandleField unreached = handle_of("linear", 1, {{infinity, infinity}});
    EdgeMeasure unreached_measure(unreached);
    CHECK(unreached_measure.worst({0, 1, 1}, 1e-3).error == 0);
}

#include "engine/core/error.h"
#include "engine/edit/handle_path.h"

#include <catch2/catch.hpp>

using namespace anvil;

TEST_CASE("a path is walked at equal speed and meets its offsets exactly") {
    const std::vector<Vec3> offsets{Vec3(0), Vec3(0.3, 0, 0), Vec3(0.3, 0.1, 0), Vec3(0.3, 0.1, 0.6)};
    const HandlePath path(offsets);
    CHECK(path.length() == Approx(1.0).epsilon(1e-15));
    const auto corners = path.corners();
    REQUIRE(corners.size() == 2);
    CHECK(corners[0] == Approx(0.3).epsilon(1e-15));
    CHECK(corners[1] == Approx(0.4).epsilon(1e-15));
    CHECK(path.at(0) == offsets[0]);
    CHECK(path.at(corners[0]) == offsets[1]);
    CHECK(path.at(corners[1]) == offsets[2]);
    CHECK(path.at(1) == offsets[3]);
    const double speed = glm::length(path.at(0.75) - path.at(0.5)) / 0.25;
    CHECK(speed == Approx(path.length()).epsilon(1e-14));
}

TEST_CASE("what a path repeats does not slow it, and its start need not be written") {
    const HandlePath plain(std::vector<Vec3>{Vec3(0), Vec3(1, 0, 0), Vec3(1, 1, 0)});
    const HandlePath repeated(std::vector<Vec3>{Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 0)});
    for (const double t : {0.0, 0.1, 0.5, 0.7, 1.0}) {
        CHECK(repeated.at(t) == plain.at(t));
    }
    CHECK(repeated.corners() == plain.corners());
}

TEST_CASE("a path that goes nowhere stays where it is, one beyond all numbers is refused") {
    const HandlePath still(std::vector<Vec3>{Vec3(0), Vec3(0)});
    CHECK(still.length() == 0);
    CHECK(still.corners().empty());
    CHECK(still.at(0.5) == Vec3(0));
    CHECK_THROWS_AS(HandlePath(std::vector<Vec3>{Vec3(0), Vec3(1e200, 0, 0)}), InputError);
}

#include "app/viewer/mirror_plane.h"

#include <catch2/catch.hpp>

using namespace anvil;

TEST_CASE("the mirror's sheet lies in its plane and reaches beyond the scene") {
    Box scene;
    scene.include(Vec3(-1, 2, 3));
    scene.include(Vec3(2, 5, 4));
    for (int axis = 0; axis < 3; ++axis) {
        const MirrorPlane::Place place = MirrorPlane::place({axis, 0.75, std::nullopt}, scene);
        Box sheet;
        for (const Vec3& corner : place.corners()) {
            CHECK(corner[axis] == Approx(0.75));
            sheet.include(corner);
        }
        for (int other = 0; other < 3; ++other) {
            if (other != axis) {
                CHECK(sheet.low[other] < scene.low[other]);
                CHECK(sheet.high[other] > scene.high[other]);
            }
        }
        CHECK(place.axes[2][axis] == 1);
    }
}

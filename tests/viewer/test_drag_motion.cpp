#include "app/viewer/drag_motion.h"

#include <catch2/catch.hpp>

using namespace anvil;

namespace {

OrbitCamera camera_at(const Vec3& direction) {
    OrbitCamera camera;
    camera.set_window(1000, 800);
    camera.frame(std::vector<Vec3>{{-1, -1, -1}, {1, 1, 1}}, direction);
    return camera;
}

Cursor cursor_at(const OrbitCamera& camera, const Vec3& point) {
    const ScreenPoint at = camera.project(point);
    return {at.x, at.y};
}

} // namespace

TEST_CASE("a handle that is dragged in the view follows the cursor") {
    const OrbitCamera camera = camera_at(Vec3(0.3, 0.4, 1));
    const Vec3 start(0.2, -0.3, 0.5);
    const Cursor from = cursor_at(camera, start);
    const Cursor to{from.x + 120, from.y - 45};
    const Vec3 by = dragged(camera, start, from, to, {});
    const ScreenPoint end = camera.project(start + by);
    CHECK(std::hypot(end.x - to.x, end.y - to.y) <= 1e-9);
    CHECK(std::abs(glm::dot(by, camera.forward())) <= 1e-12);
}

TEST_CASE("along an axis and in a plane the handle comes as near to the cursor as it can") {
    const OrbitCamera camera = camera_at(Vec3(0.5, 0.7, 1));
    const Vec3 start(0.2, -0.3, 0.5);
    const Cursor from = cursor_at(camera, start);
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 direction(0);
        direction[axis] = 2; // need not be unit
        const Vec3 wanted = start + 0.15 * direction;
        const Vec3 along =
            dragged(camera, start, from, cursor_at(camera, wanted), {DragConstraint::Kind::axis, direction});
        CHECK(glm::length(start + along - wanted) <= 1e-9);
        Vec3 within(0.11, 0.07, -0.05);
        within[axis] = 0;
        const Vec3 by = dragged(camera, start, from, cursor_at(camera, start + within),
                                {DragConstraint::Kind::plane, direction});
        CHECK(glm::length(by - within) <= 1e-9);
    }
}

TEST_CASE("looking along an axis or a plane, no drag throws the handle far away") {
    const OrbitCamera camera = camera_at(Vec3(0, 0, 1));
    const Vec3 start(0);
    const Cursor from = cursor_at(camera, start);
    const Cursor to{from.x + 100, from.y + 30};
    const Vec3 free = dragged(camera, start, from, to, {});
    for (const auto kind : {DragConstraint::Kind::axis, DragConstraint::Kind::plane}) {
        const Vec3 direction = kind == DragConstraint::Kind::axis ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
        const Vec3 by = dragged(camera, start, from, to, {kind, direction});
        CHECK(is_finite(by));
        CHECK(glm::length(by) <= 2 * glm::length(free));
    }
}

TEST_CASE("a turn is the angle that the cursor goes about the centre, by the right-hand rule of the axis") {
    const OrbitCamera camera = camera_at(Vec3(0, 0, 1));
    const Cursor middle = cursor_at(camera, Vec3(0));
    const Cursor right{middle.x + 100, middle.y};
    const Cursor above{middle.x, middle.y - 100};
    CHECK(turned(camera, Vec3(0), Vec3(0, 0, 1), right, above) == Approx(90));
    CHECK(turned(camera, Vec3(0), Vec3(0, 0, -1), right, above) == Approx(-90));
    CHECK(turned(camera, Vec3(0), Vec3(0, 0, 1), middle, above) == 0);
}

TEST_CASE("steps are round and fit the scene") {
    CHECK(round_step(100) == Approx(1));
    CHECK(round_step(220) == Approx(2));
    CHECK(round_step(0.5) == Approx(0.005));
    CHECK(round_step(0) == 1);
    CHECK(to_multiple(0.26, 0.1) == Approx(0.3));
    CHECK(to_multiple(-7.6, 5) == Approx(-10));
}

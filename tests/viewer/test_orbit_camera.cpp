#include "app/viewer/orbit_camera.h"

#include <catch2/catch.hpp>
#include <glm/gtc/constants.hpp>

using namespace anvil;

namespace {

const std::vector<Vec3> corners{{-1, -2, -3}, {1, 2, 3}, {-1, 2, 3}, {1, -2, -3}};

OrbitCamera framed(bool orthographic) {
    OrbitCamera camera;
    camera.orthographic = orthographic;
    camera.set_window(1280, 800);
    camera.frame(corners, Vec3(0.35, 0.25, 1));
    return camera;
}

double pixels_apart(const ScreenPoint& a, double x, double y) {
    return std::hypot(a.x - x, a.y - y);
}

} // namespace

TEST_CASE("a framed camera shows every point, and some point near the window's rim") {
    for (const bool orthographic : {false, true}) {
        const OrbitCamera camera = framed(orthographic);
        double least_room = infinity;
        for (const Vec3& p : corners) {
            const ScreenPoint at = camera.project(p);
            REQUIRE(at.visible());
            least_room = std::min({least_room, at.x, 1280 - at.x, at.y, 800 - at.y});
        }
        CHECK(least_room >= 0);
        CHECK(least_room <= 100);
    }
}

TEST_CASE("the ray through a point's pixel meets the point, and the picture's matrices agree") {
    for (const bool orthographic : {false, true}) {
        OrbitCamera camera = framed(orthographic);
        camera.turn(130, -47);
        camera.pan(33, 12);
        camera.zoom(1.3, 500, 300);
        Box box;
        for (const Vec3& p : corners) {
            box.include(p);
        }
        const Vec3 origin(0.2, 0.1, -0.4);
        for (const Vec3& p : corners) {
            const ScreenPoint at = camera.project(p);
            const Ray ray = camera.ray(at.x, at.y);
            CHECK(glm::length(glm::cross(p - ray.origin, ray.direction)) <= 1e-12 * camera.distance());
            const glm::vec4 clip =
                camera.projection(box) * camera.view(origin) * glm::vec4(glm::vec3(p - origin), 1);
            // Float: 1e-7 of 1280 pixels, some operations.
            CHECK(pixels_apart(at, (clip.x / clip.w + 1) * 640, (clip.y / clip.w + 1) * 400) <= 5e-3);
            CHECK(clip.z >= 0);
            CHECK(clip.z <= clip.w);
        }
    }
}

TEST_CASE("turning keeps the pivot where it is in the window, zooming the point under the cursor") {
    for (const bool orthographic : {false, true}) {
        for (const bool trackball : {false, true}) {
            OrbitCamera camera = framed(orthographic);
            camera.trackball = trackball;
            camera.set_pivot(Vec3(1, 2, 3));
            const ScreenPoint before = camera.project(Vec3(1, 2, 3));
            camera.turn(77, 31);
            CHECK(pixels_apart(camera.project(Vec3(1, 2, 3)), before.x, before.y) <= 1e-9);
            const Vec3 under = camera.ray(900, 200).origin;
            const Vec3 far =
                under + camera.ray(900, 200).direction *
                            (camera.distance() / glm::dot(camera.ray(900, 200).direction, camera.forward()));
            camera.zoom(1.7, 900, 200);
            CHECK(pixels_apart(camera.project(far), 900, 200) <= 1e-8);
        }
    }
}

TEST_CASE("setting the pivot does not change the picture") {
    OrbitCamera camera = framed(false);
    std::vector<ScreenPoint> before;
    for (const Vec3& p : corners) {
        before.push_back(camera.project(p));
    }
    camera.set_pivot(Vec3(0.7, -1, 0.2));
    for (size_t i = 0; i < corners.size(); ++i) {
        CHECK(pixels_apart(camera.project(corners[i]), before[i].x, before[i].y) <= 1e-9);
    }
}

TEST_CASE("a turntable stays upright, whichever axis is up") {
    for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
        OrbitCamera camera = framed(false);
        camera.set_up(up);
        const Vec3 axis = up == UpAxis::y ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
        for (int i = 0; i < 20; ++i) {
            camera.turn(37, 5);
            CHECK(std::abs(glm::dot(camera.right(), axis)) <= 1e-12);
        }
    }
}

TEST_CASE("front, right and top look along their axes with the top up") {
    OrbitCamera camera = framed(false);
    camera.look_from(Vec3(0, 0, 1));
    CHECK(glm::length(camera.forward() - Vec3(0, 0, -1)) <= 1e-12);
    CHECK(glm::length(camera.right() - Vec3(1, 0, 0)) <= 1e-12);
    camera.look_from(Vec3(1, 0, 0));
    CHECK(glm::length(camera.up() - Vec3(0, 1, 0)) <= 1e-12);
    CHECK(glm::length(camera.right() - Vec3(0, 0, -1)) <= 1e-12);
    camera.look_from(Vec3(0, 1, 0));
    CHECK(glm::length(camera.forward() - Vec3(0, -1, 0)) <= 1e-12);
    CHECK(glm::length(camera.right() - Vec3(1, 0, 0)) <= 1e-12);
}

#include "app/viewer/script.h"
#include "tests/viewer/edited_sphere.h"

#include <catch2/catch.hpp>

using namespace anvil;

namespace {

InputEvent move_to(double x, double y, Modifiers held = {}) {
    InputEvent event;
    event.x = x;
    event.y = y;
    event.modifiers = held;
    return event;
}

InputEvent button(InputEvent::Kind kind, MouseButton which = MouseButton::left, Modifiers held = {}) {
    InputEvent event;
    event.kind = kind;
    event.button = which;
    event.modifiers = held;
    return event;
}

/// An editor over a sphere of radius 1, seen from the front.
struct Bench : test::EditedSphere {
    void move(double x, double y, Modifiers held = {}) { send(move_to(x, y, held)); }
    void press(Modifiers held = {}) { send(button(InputEvent::Kind::press, MouseButton::left, held)); }
    void release() { send(button(InputEvent::Kind::release)); }
    void key(const std::string& name) { send(key_event(name, true)); }
    void type(const std::string& text) {
        for (const char c : text) {
            InputEvent event;
            event.kind = InputEvent::Kind::text;
            event.character = static_cast<unsigned char>(c);
            send(event);
        }
    }
};

} // namespace

TEST_CASE("the surface under the cursor is found, with its address and normal") {
    Bench bench;
    bench.move(540, 380);
    REQUIRE(bench.editor.hover());
    const SurfaceHit& hit = *bench.editor.hover();
    const ScreenPoint at = bench.camera.project(hit.position);
    CHECK(std::hypot(at.x - 540, at.y - 380) <= 1e-6);
    CHECK(hit.position.z > 0); // the side that faces the eye
    CHECK(glm::dot(hit.normal, hit.position) > 0.9);
    CHECK(glm::length(*bench.surface.position(hit.address) - hit.position) <= 1e-9);
    bench.move(3, 3);
    CHECK_FALSE(bench.editor.hover());
}

TEST_CASE("a point that is dragged in one go is an edit that is taken on release") {
    Bench bench;
    bench.move(500, 400);
    bench.press();
    bench.move(560, 370);
    CHECK(bench.editor.take_wish() == EditorWish::preview);
    bench.release();
    CHECK(bench.editor.take_wish() == EditorWish::commit);
    const Edit edit = bench.editor.edit();
    REQUIRE(edit.handles.size() == 1);
    const Vec3 target = *bench.surface.position(edit.handles[0].at) + *edit.handles[0].by;
    const ScreenPoint end = bench.camera.project(target);
    CHECK(std::hypot(end.x - 560, end.y - 370) <= 1e-6);
    CHECK(edit.radius == 0.5);
}

TEST_CASE("a click leaves a handle, further ones join with Shift, and Enter takes them all") {
    Bench bench;
    bench.move(500, 400);
    bench.press();
    bench.release();
    CHECK(bench.editor.take_wish() == EditorWish::preview);
    bench.move(600, 400);
    bench.press({.shift = true});
    bench.release();
    REQUIRE(bench.editor.handles().size() == 2);
    bench.move(640, 400, {});
    bench.press();
    CHECK(bench.editor.handles().size() == 1); // without Shift a click begins anew
    bench.key("escape");
    CHECK_FALSE(bench.editor.has_handles());
}

TEST_CASE("a handle among several is dragged alone and stays until Enter") {
    Bench bench;
    for (const double x : {450.0, 600.0}) {
        bench.move(x, 400);
        bench.press({.shift = true});
        bench.release();
    }
    bench.move(450, 400);
    bench.press();
    bench.move(450, 300);
    bench.release();
    CHECK(bench.editor.take_wish() == EditorWish::preview);
    const Edit edit = bench.editor.edit();
    REQUIRE(edit.handles.size() == 2);
    CHECK(glm::length(*edit.handles[0].by) > 0.1);
    CHECK(*edit.handles[1].by == Vec3(0));
    bench.key("enter");
    CHECK(bench.editor.take_wish() == EditorWish::commit);
}

TEST_CASE("escape in mid-drag brings back what was before") {
    Bench bench;
    bench.move(500, 400);
    bench.press();
    bench.move(560, 370);
    bench.key("escape");
    CHECK_FALSE(bench.editor.dragging());
    CHECK_FALSE(bench.editor.has_handles());
    CHECK(bench.editor.take_wish() == EditorWish::drop);
}

TEST_CASE("axes, typed numbers, snapping and precision hold the drag to what is asked") {
    Bench bench;
    bench.move(500, 400);
    bench.press();
    bench.move(560, 340);
    bench.key("x");
    Vec3 by = *bench.editor.edit().handles[0].by;
    CHECK(by.x > 0);
    CHECK(glm::length(Vec3(0, by.y, by.z)) <= 1e-12);
    bench.type("0.25-");
    CHECK(glm::length(*bench.editor.edit().handles[0].by - Vec3(-0.25, 0, 0)) <= 1e-12);
    for (int i = 0; i < 5; ++i) {
        bench.key("backspace");
    }
    bench.key("x"); // again: free
    const Vec3 free = *bench.editor.edit().handles[0].by;
    CHECK(free.y > 0);
    bench.move(563, 340, {.control = true});
    by = *bench.editor.edit().handles[0].by;
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(std::abs(by[axis] / 0.05 - std::round(by[axis] / 0.05)) <= 1e-9); // of 10 radii
    }
    bench.move(663, 340, {.shift = true}); // a hundred pixels as ten
    const Vec3 slow = *bench.editor.edit().handles[0].by;
    CHECK(slow.x - free.x ==
          Approx(13 * bench.camera.pixel_size(
                          bench.camera.project(bench.editor.handles()[0].place.position).depth)));
}

TEST_CASE("a turn goes about the view axis through the anchors' middle") {
    Bench bench;
    bench.editor.tool = Tool::move;
    bench.move(500, 300);
    bench.press();
    bench.release();
    bench.key("a");
    bench.move(500, 400);
    bench.press();
    REQUIRE(bench.editor.handles()[0].anchors.size() == 1);
    bench.editor.take_wish();
    bench.move(600, 400);
    bench.key("r");
    bench.move(500, 500); // from the right of the centre to below: clockwise in the window
    const Edit edit = bench.editor.edit();
    CHECK(edit.kind == EditKind::rotate);
    CHECK(glm::length(edit.axis.origin - bench.editor.handles()[0].anchors[0].position) <= 1e-12);
    CHECK(*edit.handles[0].degrees == Approx(-90).margin(1));
    CHECK(edit.anchors.size() == 1);
    bench.type("30");
    CHECK(*bench.editor.edit().handles[0].degrees == 30);
    bench.press(); // a click takes the place
    CHECK_FALSE(bench.editor.dragging());
    CHECK(bench.editor.has_handles());
}

TEST_CASE("the wheel changes the radius while a handle is held, and is the view's else") {
    Bench bench;
    InputEvent wheel;
    wheel.kind = InputEvent::Kind::scroll;
    wheel.y = 1;
    CHECK_FALSE(bench.editor.handle(wheel, bench.camera, &bench.surface));
    bench.move(500, 400);
    bench.press();
    CHECK(bench.editor.handle(wheel, bench.camera, &bench.surface));
    CHECK(bench.editor.radius > 0.5);
}

#include "app/viewer/occluder_tool.h"
#include "app/viewer/recorded_motion.h"
#include "app/viewer/script.h"
#include "engine/mesh/sample_shapes.h"
#include "engine/occluder/occluder_motion.h"

#include <catch2/catch.hpp>

using namespace anvil;

namespace {

constexpr double rounding = 1e-12; ///< of places up to 10 from the origin, some dozens of operations

InputEvent at(double x, double y, Modifiers held = {}) {
    InputEvent event;
    event.x = x;
    event.y = y;
    event.modifiers = held;
    return event;
}

InputEvent button(InputEvent::Kind kind) {
    InputEvent event;
    event.kind = kind;
    return event;
}

/// Two balls of radius 1, seen from the front: one in the middle, one to the right of it.
struct Bench {
    Mesh ball = make_sample("icosphere", 642);
    std::vector<OccluderView> occluders;
    OrbitCamera camera;
    OccluderTool tool;

    Bench() {
        const auto tree = std::make_shared<const SearchTree>(ball.positions, ball.triangles);
        occluders.push_back({"middle", nullptr, tree, Vec3(0), {}});
        occluders.push_back({"right", nullptr, tree, Vec3(0), {}});
        occluders[1].transform.translate = Vec3(4, 0, 0);
        camera.set_window(1000, 800);
        const std::vector<Vec3> corners{Vec3(-6, -6, -6), Vec3(6, 6, 6)};
        camera.frame(corners, Vec3(0.2, 0.3, 1));
        tool.set_scene_size(10);
    }

    bool send(const InputEvent& event) { return tool.handle(event, camera, occluders, nullptr); }
    void move(double x, double y, Modifiers held = {}) { send(at(x, y, held)); }
    void press() { send(button(InputEvent::Kind::press)); }
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
    glm::dvec2 window_place(const Vec3& place) const {
        const ScreenPoint p = camera.project(place);
        return {p.x, p.y};
    }
    void click(const Vec3& place) {
        const glm::dvec2 p = window_place(place);
        move(p.x, p.y);
        press();
        release();
    }
    /// To the middle of the mark's line, where no other one is.
    glm::dvec2 grab(GizmoPart part) {
        const std::vector<GizmoMark> marks = tool.marks(camera, occluders);
        for (const GizmoMark& mark : marks) {
            if (mark.part != part) {
                continue;
            }
            glm::dvec2 middle(0);
            for (const glm::dvec2& p : mark.line) {
                middle += p / static_cast<double>(mark.line.size());
            }
            std::vector<glm::dvec2> places = mark.line;
            places.insert(places.begin(), middle);
            for (const glm::dvec2& p : places) {
                if (gizmo_part_at(marks, p.x, p.y) == part) {
                    move(p.x, p.y);
                    press();
                    return p;
                }
            }
        }
        FAIL("no place of the mark can be grabbed");
        return {};
    }
    Transform shown(size_t i = 0) const { return tool.shown(occluders[i]); }
};

void check_same_place(const Transform& transform, const std::array<Vec3, 4>& expected) {
    // The images of the origin and the axes' ends say all of a transform.
    const std::array<Vec3, 4> points{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    for (size_t i = 0; i < 4; ++i) {
        CHECK(glm::length(placed_point(transform, points[i]) - expected[i]) <= rounding);
    }
}

} // namespace

TEST_CASE("a click selects the occluder under the cursor, one beside them none") {
    Bench bench;
    bench.click(Vec3(4, 0, 0));
    CHECK(bench.tool.selected() == "right");
    CHECK(bench.tool.take_wish() == OccluderWish::nothing);
    bench.click(Vec3(0, -0.5, 0));
    CHECK(bench.tool.selected() == "middle");
    bench.move(3, 3);
    bench.press();
    CHECK(bench.tool.selected().empty());
}

TEST_CASE("every mark of the gizmo can be grabbed from many sides, and marks move with the occluder") {
    Bench bench;
    bench.tool.select("middle");
    for (const Vec3& side : {Vec3(1, 1, 1), Vec3(-1, 0.4, 0.6), Vec3(0.5, -0.7, -1)}) {
        bench.camera.look_from(side);
        for (int axis = 0; axis < 3; ++axis) {
            for (const GizmoAction action : {GizmoAction::move, GizmoAction::across, GizmoAction::turn}) {
                bench.grab({action, axis});
                CHECK(bench.tool.dragging());
                bench.key("escape");
                CHECK_FALSE(bench.tool.dragging());
            }
        }
        for (const GizmoAction action :
             {GizmoAction::move_freely, GizmoAction::turn_in_view, GizmoAction::scale}) {
            bench.grab({action, 0});
            CHECK(bench.tool.hot() == GizmoPart{action, 0});
            bench.key("escape");
        }
    }
}

TEST_CASE("an arrow moves along its axis to under the cursor, and release asks for the place") {
    Bench bench;
    bench.tool.select("middle");
    const glm::dvec2 from = bench.grab({GizmoAction::move, 0});
    // The way in the window of a step of 2 along x, seen in perspective from where it was grabbed.
    const auto grabbed = dragged(bench.camera, Vec3(0), {from.x, from.y}, {from.x + 80, from.y},
                                 {DragConstraint::Kind::axis, Vec3(1, 0, 0)});
    bench.move(from.x + 80, from.y);
    CHECK(bench.tool.take_wish() == OccluderWish::preview);
    const Transform now = bench.shown();
    CHECK(now.translate.x > 0.5);
    CHECK(now.translate.y == 0);
    CHECK(now.translate.z == 0);
    CHECK(now.translate == grabbed);
    bench.release();
    CHECK(bench.tool.take_wish() == OccluderWish::moved);
    CHECK(bench.shown() == now); // until what was asked for is done
    bench.tool.settle();
    CHECK(bench.shown() == Transform{});
}

TEST_CASE("typed numbers move, turn and scale exactly") {
    Bench bench;
    bench.tool.select("right");
    bench.grab({GizmoAction::move, 1});
    bench.type("1.25-");
    CHECK(bench.shown(1).translate == Vec3(4, -1.25, 0));
    bench.key("z");
    CHECK(bench.shown(1).translate == Vec3(4, 0, -1.25));
    bench.key("escape");

    bench.grab({GizmoAction::turn, 2});
    bench.type("90");
    check_same_place(bench.shown(1), {Vec3(4, 0, 0), Vec3(4, 1, 0), Vec3(3, 0, 0), Vec3(4, 0, 1)});
    CHECK(bench.shown(1).degrees == 90);
    CHECK(bench.shown(1).axis == Vec3(0, 0, 1));
    bench.key("escape");

    bench.grab({GizmoAction::scale, 0});
    bench.type("2.5");
    CHECK(bench.shown(1).scale == 2.5);
    CHECK(bench.shown(1).translate == Vec3(4, 0, 0));
    bench.release();
    CHECK(bench.tool.take_wish() == OccluderWish::moved);
}

TEST_CASE("a pivot beside the origin stays where it is under turns and scalings") {
    Bench bench;
    bench.occluders[0].pivot = Vec3(0.5, 0.25, -1);
    bench.occluders[0].transform = {Vec3(1, 2, 3), Vec3(1, 1, 0), 40, 1.5};
    bench.tool.select("middle");
    const Vec3 before = placed_point(bench.shown(), Vec3(0.5, 0.25, -1));
    const Vec3 marked = placed_point(bench.shown(), Vec3(1.5, 0.25, -1));
    bench.grab({GizmoAction::turn, 1});
    bench.type("70");
    CHECK(glm::length(placed_point(bench.shown(), Vec3(0.5, 0.25, -1)) - before) <= rounding);
    // A turn about y by 70 degrees of what was there before.
    const double c = std::cos(glm::radians(70.0));
    const double s = std::sin(glm::radians(70.0));
    const Vec3 arm = marked - before;
    const Vec3 turned_arm(c * arm.x + s * arm.z, arm.y, c * arm.z - s * arm.x);
    CHECK(glm::length(placed_point(bench.shown(), Vec3(1.5, 0.25, -1)) - before - turned_arm) <= rounding);
    bench.key("escape");
    bench.grab({GizmoAction::scale, 0});
    bench.type("3");
    CHECK(glm::length(placed_point(bench.shown(), Vec3(0.5, 0.25, -1)) - before) <= rounding);
    CHECK(glm::length(placed_point(bench.shown(), Vec3(1.5, 0.25, -1)) - before - 3.0 * arm) <= rounding);
}

TEST_CASE("turns about one axis add up beyond a full turn, others are the product of both") {
    const Transform half = turned_about({}, Vec3(0, 2, 0), 200, Vec3(0));
    CHECK(turned_about(half, Vec3(0, 1, 0), 200, Vec3(0)).degrees == 400);
    CHECK(turned_about(half, Vec3(0, -1, 0), 200, Vec3(0)).degrees == 0);
    const Transform both =
        turned_about(turned_about({}, Vec3(1, 0, 0), 90, Vec3(0)), Vec3(0, 0, 1), 90, Vec3(0));
    // x to y; y by the first to z, which the second leaves; z to -y to x.
    check_same_place(both, {Vec3(0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 0, 0)});
}

TEST_CASE("the ring follows the cursor around, also seen from its side, Ctrl by whole steps") {
    Bench bench;
    bench.tool.select("middle");
    bench.camera.look_from(Vec3(0, 0, 1));
    const glm::dvec2 middle = bench.window_place(Vec3(0));
    const glm::dvec2 grabbed = bench.grab({GizmoAction::turn_in_view, 0});
    const double begin = std::atan2(middle.y - grabbed.y, grabbed.x - middle.x);
    for (int i = 1; i <= 30; ++i) { // counterclockwise
        const double angle = begin + glm::radians(i * 1.0);
        bench.move(middle.x + 118 * std::cos(angle), middle.y - 118 * std::sin(angle));
    }
    CHECK(bench.shown().degrees == Approx(30));
    CHECK(glm::length(bench.shown().axis - Vec3(0, 0, 1)) <= 1e-12);
    bench.move(middle.x + 118 * std::cos(begin + 0.6), middle.y - 118 * std::sin(begin + 0.6),
               {.control = true}); // 34 degrees
    CHECK(bench.shown().degrees == Approx(30).margin(1e-9));
    bench.key("escape");
    // The ring about y is a line from left to right here: a way of 100 pixels to the right is a radian.
    const glm::dvec2 side = bench.grab({GizmoAction::turn, 1});
    bench.move(side.x + 50, side.y);
    CHECK(bench.shown().degrees == Approx(glm::degrees(0.5)).epsilon(0.02)); // perspective
}

TEST_CASE("escape and the right button bring the occluder back") {
    Bench bench;
    bench.tool.select("middle");
    const glm::dvec2 from = bench.grab({GizmoAction::move_freely, 0});
    bench.move(from.x + 50, from.y + 20);
    CHECK(bench.shown().translate != Vec3(0));
    bench.key("escape");
    CHECK(bench.shown() == Transform{});
    bench.grab({GizmoAction::move_freely, 0});
    bench.move(from.x + 50, from.y + 20);
    InputEvent right = button(InputEvent::Kind::press);
    right.button = MouseButton::right;
    bench.send(right);
    CHECK(bench.shown() == Transform{});
    CHECK(bench.tool.take_wish() == OccluderWish::preview);
}

TEST_CASE("a drag that is recorded becomes a motion and leaves the occluder's place") {
    Bench bench;
    bench.tool.select("middle");
    bench.tool.records = true;
    const glm::dvec2 from = bench.grab({GizmoAction::move, 1});
    for (int i = 1; i <= 10; ++i) {
        bench.move(from.x, from.y + 8 * i);
    }
    const Transform end = bench.shown();
    bench.release();
    CHECK(bench.tool.take_wish() == OccluderWish::preview);
    REQUIRE(bench.tool.has_motion());
    const std::vector<MotionPose> motion = bench.tool.motions().at("middle");
    REQUIRE(motion.size() == 2); // a straight way needs no more
    CHECK(motion[0] == MotionPose{0, Vec3(0), {}, {}});
    CHECK(motion[1] == MotionPose{1, end.translate, {}, {}});
    // What follows goes on from there.
    bench.grab({GizmoAction::move, 0});
    bench.type("2");
    bench.release();
    const std::vector<MotionPose> longer = bench.tool.motions().at("middle");
    REQUIRE(longer.size() == 3);
    CHECK(*longer[1].translate == end.translate);
    CHECK(*longer[2].translate == end.translate + Vec3(2, 0, 0));
    const double first = glm::length(end.translate);
    CHECK(longer[1].at == Approx(first / (first + 2))); // at equal speed
    bench.tool.clear_motions();
    CHECK_FALSE(bench.tool.has_motion());
    CHECK(bench.shown() == Transform{});
}

TEST_CASE("a recorded motion is near every pose that was recorded, with as few poses as that takes") {
    // A quarter of a circle, turning and growing on the way.
    std::vector<Transform> poses;
    for (int i = 0; i <= 200; ++i) {
        const double angle = glm::radians(0.45 * i);
        poses.push_back(
            {Vec3(3 * std::cos(angle), 3 * std::sin(angle), 0), Vec3(0, 0, 1), 1.2 * i, std::exp(0.001 * i)});
    }
    constexpr double tolerance = 0.01;
    const std::vector<MotionPose> motion = recorded_motion(poses, 0.5, tolerance);
    REQUIRE(motion.size() >= 3);
    CHECK(motion.size() <= 20);
    CHECK(motion.front().at == 0);
    CHECK(motion.back().at == 1);
    const OccluderUse use{"hammer", Transform{}, Influence{}, motion};
    const std::vector<TimedPose> timed = timed_poses(use);
    double length = 0;
    std::vector<double> times{0};
    for (size_t i = 1; i < poses.size(); ++i) {
        length += way_between(poses[i - 1], poses[i], 0.5);
        times.push_back(length);
    }
    for (size_t i = 0; i < poses.size(); ++i) {
        const Placement told = pose_at(timed, times[i] / length);
        const Placement recorded = placement(poses[i]);
        CHECK(glm::length(told.origin - recorded.origin) <= tolerance + 1e-12);
        CHECK(std::abs(told.scale / recorded.scale - 1) <= tolerance / 0.5 + 1e-9);
        CHECK(glm::dot(told.axes[0], recorded.axes[0]) >= std::cos(tolerance / 0.5 + 1e-6));
    }
    CHECK(recorded_motion(std::vector<Transform>(5), 0.5, tolerance).empty());
}

TEST_CASE("a typed turn of most of a circle is recorded the long way, as it was typed") {
    Bench bench;
    bench.tool.select("middle");
    bench.tool.records = true;
    bench.grab({GizmoAction::turn, 1});
    bench.type("270");
    bench.release();
    const std::vector<MotionPose> motion = bench.tool.motions().at("middle");
    REQUIRE(motion.size() >= 3); // two would turn the other way
    CHECK(motion.back().rotate->degrees == 270);
    const Placement half = pose_at(timed_poses({"middle", Transform{}, Influence{}, motion}), 0.5);
    const Placement expected = placement({Vec3(0), Vec3(0, 1, 0), 135, 1});
    CHECK(glm::length(half.axes[0] - expected.axes[0]) <= 1e-9);
}

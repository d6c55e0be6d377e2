#include "app/viewer/recorded_path.h"
#include "app/viewer/script.h"
#include "engine/edit/handle_path.h"
#include "tests/viewer/edited_sphere.h"

#include <catch2/catch.hpp>
#include <numbers>

using namespace anvil;

namespace {

double apart(const Vec3& p, const std::vector<Vec3>& line) {
    double least = infinity;
    for (size_t i = 1; i < line.size(); ++i) {
        const Vec3 way = line[i] - line[i - 1];
        const double length = glm::dot(way, way);
        const double s = length > 0 ? std::clamp(glm::dot(p - line[i - 1], way) / length, 0.0, 1.0) : 0;
        least = std::min(least, glm::length(p - line[i - 1] - s * way));
    }
    return least;
}

/// An editor over a sphere of radius 1, seen from the front, with the point in the middle in hand.
struct Bench : test::EditedSphere {
    Bench() {
        editor.follow_path = true;
        move(500, 400);
        send(InputEvent::Kind::press);
    }

    void move(double x, double y) {
        InputEvent event;
        event.x = x;
        event.y = y;
        editor.handle(event, camera, &surface);
    }
    void send(InputEvent::Kind kind) {
        InputEvent event;
        event.kind = kind;
        editor.handle(event, camera, &surface);
    }
    void key(const std::string& name) { editor.handle(key_event(name, true), camera, &surface); }
};

} // namespace

TEST_CASE("a path keeps within the tolerance of every place with few of them, its ends as they were") {
    std::vector<Vec3> circle;
    for (int i = 0; i <= 400; ++i) {
        const double angle = 2 * std::numbers::pi * i / 400;
        circle.emplace_back(std::cos(angle) - 1, std::sin(angle), 0.1 * std::sin(3 * angle));
    }
    circle.back() = circle.front(); // closed, to the bit
    const std::vector<Vec3> path = thinned_path(circle, 0.01);
    CHECK(path.size() >= 10); // a chord of a circle with a sagitta of 0.01 spans 16 degrees
    CHECK(path.size() <= 60);
    CHECK(path.front() == circle.front());
    CHECK(path.back() == circle.back());
    for (const Vec3& place : circle) {
        CHECK(apart(place, path) <= 0.01);
    }
    CHECK(thinned_path(std::vector<Vec3>(7, Vec3(1, 2, 3)), 0.01).empty());
    const std::vector<Vec3> straight{Vec3(0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(5, 0, 0)};
    CHECK(thinned_path(straight, 0.01) == std::vector<Vec3>{Vec3(0), Vec3(5, 0, 0)});
}

TEST_CASE("a drag whose path counts becomes the handle's path, there and back too") {
    Bench bench;
    for (const auto& [x, y] : {std::pair(560, 400), {560, 340}, {500, 340}}) {
        bench.move(x, y);
    }
    bench.move(500, 400); // where it began
    bench.send(InputEvent::Kind::release);
    CHECK(bench.editor.take_wish() == EditorWish::commit);
    const Edit edit = bench.editor.edit();
    REQUIRE(edit.handles.size() == 1);
    CHECK_FALSE(edit.handles[0].by);
    const std::vector<Vec3>& path = edit.handles[0].path;
    REQUIRE(path.size() == 5); // a square
    CHECK(path[0] == Vec3(0));
    CHECK(glm::length(path[4]) <= 1e-12);
    const double pixel =
        bench.camera.pixel_size(bench.camera.project(bench.editor.handles()[0].place.position).depth);
    CHECK(path[2].x == Approx(60 * pixel).epsilon(1e-6));
    CHECK(path[2].y == Approx(60 * pixel).epsilon(1e-6));
    CHECK(HandlePath(path).length() == Approx(240 * pixel).epsilon(1e-6));
}

TEST_CASE("a length that is typed has the straight way, and escape takes the path back") {
    Bench bench;
    bench.move(560, 400);
    bench.move(560, 340);
    bench.key("x");
    InputEvent digit;
    digit.kind = InputEvent::Kind::text;
    digit.character = '2';
    bench.editor.handle(digit, bench.camera, &bench.surface);
    const std::vector<Vec3> path = bench.editor.edit().handles[0].path;
    REQUIRE(path.size() == 2);
    CHECK(path[0] == Vec3(0));
    CHECK(path[1] == Vec3(2, 0, 0));
    bench.key("escape");
    CHECK_FALSE(bench.editor.has_handles());
}

TEST_CASE("without the wish for paths a drag is what it was, a way to its end") {
    Bench bench;
    bench.editor.follow_path = false;
    bench.move(560, 400);
    bench.move(560, 340);
    CHECK(bench.editor.edit().handles[0].by);
    CHECK(bench.editor.edit().handles[0].path.empty());
}

#include "app/viewer/line_tool.h"
#include "app/viewer/script.h"
#include "engine/mesh/sample_shapes.h"

#include <catch2/catch.hpp>

using namespace anvil;

namespace {

struct Desk {
    Mesh mesh = make_sample("icosphere", 2562);
    RefinementHistory history{mesh};
    PickSurface surface{mesh, history, mesh.positions};
    OrbitCamera camera;
    LineTool tool;

    Desk() {
        camera.set_window(1000, 800);
        camera.frame(mesh.positions, Vec3(0, 0, 1));
    }

    bool click(double x, double y, Modifiers held = {}) {
        InputEvent event;
        event.x = x;
        event.y = y;
        tool.handle(event, camera, &surface);
        event.kind = InputEvent::Kind::press;
        event.modifiers = held;
        return tool.handle(event, camera, &surface);
    }
    bool key(const std::string& name) { return tool.handle(key_event(name, true), camera, &surface); }
};

} // namespace

TEST_CASE("clicks one after the other are a line's points, and Enter ends it") {
    Desk desk;
    CHECK_FALSE(desk.key("enter")); // nothing to end
    CHECK(desk.click(450, 400));
    CHECK(desk.click(520, 380));
    CHECK(desk.click(560, 450));
    CHECK_FALSE(desk.click(5, 5)); // beside the surface
    CHECK(desk.key("backspace"));
    CHECK(desk.tool.line().points.size() == 2);
    CHECK_FALSE(desk.tool.take());
    CHECK(desk.key("enter"));
    const auto finished = desk.tool.take();
    REQUIRE(finished);
    CHECK_FALSE(finished->further);
    REQUIRE(finished->line.points.size() == 2);
    const ScreenPoint first = desk.camera.project(finished->line.points[0].position);
    CHECK(std::hypot(first.x - 450, first.y - 400) <= 1e-6);
    CHECK(desk.tool.line().points.empty());
}

TEST_CASE("a click at the last point ends a line, one at the first point closes it") {
    Desk desk;
    desk.click(450, 400);
    desk.click(520, 380);
    desk.click(521, 381, {.shift = true});
    auto finished = desk.tool.take();
    REQUIRE(finished);
    CHECK(finished->further);
    CHECK(finished->line.points.size() == 2);
    for (const auto& [x, y] : {std::pair(450.0, 400.0), {520.0, 380.0}, {560.0, 450.0}, {451.0, 402.0}}) {
        desk.click(x, y);
    }
    finished = desk.tool.take();
    REQUIRE(finished);
    REQUIRE(finished->line.points.size() == 4);
    CHECK(finished->line.points.front().at == finished->line.points.back().at);
    desk.click(450, 400);
    CHECK(desk.key("escape"));
    CHECK(desk.tool.line().points.empty());
    CHECK_FALSE(desk.tool.take());
}

TEST_CASE("a line takes the way that was found for its own points alone") {
    Desk desk;
    desk.click(450, 400);
    desk.click(520, 380);
    const std::vector<SurfaceAddress> points = desk.tool.line().addresses();
    const std::vector<Vec3> path{{0, 0, 1}, {0.1, 0, 1}, {0.2, 0, 1}};
    desk.click(560, 450);
    desk.tool.set_path(points, path);
    CHECK(desk.tool.line().path.empty());
    desk.tool.set_path(desk.tool.line().addresses(), path);
    CHECK(desk.tool.line().places() == path);
}

// Anchors, pins, lines and the mirror plane of the edit under way.
#include "app/viewer/script.h"
#include "tests/viewer/edited_sphere.h"

#include <catch2/catch.hpp>

using namespace anvil;

namespace {

struct Table : test::EditedSphere {
    void move(double x, double y) {
        InputEvent event;
        event.x = x;
        event.y = y;
        editor.handle(event, camera, &surface);
    }
    void button(InputEvent::Kind kind) {
        InputEvent event;
        event.kind = kind;
        editor.handle(event, camera, &surface);
    }
    void click(double x, double y) {
        move(x, y);
        button(InputEvent::Kind::press);
        button(InputEvent::Kind::release);
    }
    void key(const std::string& name) { editor.handle(key_event(name, true), camera, &surface); }
    PickedPlace vertex(uint32_t v) const { return {VertexAddress{v}, mesh.positions[v], Vec3(0)}; }
};

} // namespace

TEST_CASE("a handle takes any number of anchors: points, faces and lines, each as the recipe has it") {
    Table table;
    table.click(500, 400);
    table.key("a");
    table.click(450, 400);
    table.click(550, 400);
    table.editor.add_anchors({{{12}, Vec3(0)}, {{13}, Vec3(0)}}, {table.vertex(5)});
    table.editor.add_line({{table.vertex(7), table.vertex(9)}, {}}, false);
    const Edit edit = table.editor.edit();
    REQUIRE(edit.handles.size() == 1);
    REQUIRE(edit.anchors.size() == 1);
    CHECK(edit.anchors[0].at.size() == 6);
    size_t points = 0;
    size_t faces = 0;
    for (const AnchorAddress& anchor : edit.anchors[0].at) {
        points += std::holds_alternative<SurfaceAddress>(anchor) ? 1 : 0;
        faces += std::holds_alternative<WholeFaceAddress>(anchor) ? 1 : 0;
        if (const auto* line = std::get_if<PolylineAddress>(&anchor)) {
            CHECK(line->points == std::vector<SurfaceAddress>{VertexAddress{7}, VertexAddress{9}});
        }
    }
    CHECK(points == 3);
    CHECK(faces == 2);
}

TEST_CASE("a line without a handle is one, held at its middle; a further one is another handle") {
    Table table;
    table.editor.add_line({{table.vertex(3), table.vertex(40), table.vertex(41)}, {}}, false);
    CHECK(table.editor.take_wish() == EditorWish::preview);
    table.editor.add_line({{table.vertex(100), table.vertex(101)}, {}}, true);
    const Edit edit = table.editor.edit();
    REQUIRE(edit.handles.size() == 2);
    CHECK(std::get<VertexAddress>(edit.handles[0].at).vertex == 40);
    REQUIRE(edit.anchors.size() == 2);
    CHECK(edit.anchors[1].handle == 1);
    const std::vector<Vec3> path{{0, 0, 1}, {0, 0.1, 1}};
    table.editor.set_path({VertexAddress{100}, VertexAddress{101}}, path);
    CHECK(table.editor.handles()[1].anchor_lines[0].path == path);
    CHECK(table.editor.handles()[0].anchor_lines[0].path.empty());
}

TEST_CASE("pins that last are in every edit, and a drag in one go is still a whole edit") {
    Table table;
    table.editor.set_lasting_pins({table.vertex(1), table.vertex(2)});
    for (int i = 0; i < 2; ++i) {
        table.move(500, 400);
        table.button(InputEvent::Kind::press);
        table.move(560, 370);
        table.button(InputEvent::Kind::release);
        CHECK(table.editor.take_wish() == EditorWish::commit);
        CHECK(table.editor.edit().pinned == std::vector<SurfaceAddress>{VertexAddress{1}, VertexAddress{2}});
        table.editor.clear();
    }
    CHECK(table.editor.lasting_pins().size() == 2);
}

TEST_CASE("a mirrored edit says so, and turns about an axis that both sides can have") {
    Table table;
    table.editor.mirror = Mirror{1, 0.25, std::nullopt};
    table.click(500, 300);
    CHECK(table.editor.edit().mirror == table.editor.mirror);
    table.key("r");
    CHECK(table.editor.axis().direction == Vec3(0, 1, 0));
    CHECK(table.editor.edit().kind == EditKind::rotate);
}

TEST_CASE("after a change of the surface the cursor is over the new one") {
    Table table;
    table.move(510, 390);
    REQUIRE(table.editor.hover());
    std::vector<Vec3> larger = table.mesh.positions;
    for (Vec3& p : larger) {
        p *= 1.25;
    }
    const PickSurface grown(table.mesh, table.history, larger);
    table.editor.surface_changed(table.camera, &grown);
    REQUIRE(table.editor.hover());
    // Chords of the icosphere's faces lie up to a hundredth below the ball.
    CHECK(glm::length(table.editor.hover()->position) == Approx(1.25).epsilon(0.01));
    table.editor.surface_changed(table.camera, nullptr);
    CHECK_FALSE(table.editor.hover());
}

TEST_CASE("z up: front, right and top follow, and turning keeps z upright") {
    OrbitCamera camera;
    camera.set_window(1000, 800);
    camera.set_up(UpAxis::z);
    camera.look_from(camera.side(Vec3(0, 0, 1)));
    CHECK(glm::length(camera.forward() - Vec3(0, 1, 0)) <= 1e-12); // the front is at -y
    CHECK(glm::length(camera.up() - Vec3(0, 0, 1)) <= 1e-12);
    camera.look_from(camera.side(Vec3(1, 0, 0)));
    CHECK(glm::length(camera.forward() - Vec3(-1, 0, 0)) <= 1e-12);
    camera.look_from(camera.side(Vec3(0, 1, 0)));
    CHECK(glm::length(camera.forward() - Vec3(0, 0, -1)) <= 1e-12);
    camera.look_from(camera.side(Vec3(0.3, 0.4, 1)));
    camera.turn(123, 45);
    CHECK(std::abs(glm::dot(camera.right(), Vec3(0, 0, 1))) <= 1e-12);
}

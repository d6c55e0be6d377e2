#include "app/viewer/select_region.h"
#include "app/viewer/select_tool.h"
#include "app/viewer/selected_places.h"
#include "app/viewer/selection.h"
#include "engine/mesh/sample_shapes.h"

#include <catch2/catch.hpp>
#include <numeric>
#include <set>

using namespace anvil;

namespace {

/// A sphere of radius 1, seen from the front.
struct Ball {
    Mesh mesh = make_sample("icosphere", 2562);
    RefinementHistory history{mesh};
    PickSurface surface{mesh, history, mesh.positions};
    OrbitCamera camera;

    explicit Ball(bool orthographic = false) {
        camera.orthographic = orthographic;
        camera.set_window(1000, 800);
        camera.frame(mesh.positions, Vec3(0.3, 0.2, 1));
    }

    std::vector<uint32_t> within(std::initializer_list<Cursor> outline, bool through) const {
        const std::vector<Cursor> points(outline);
        return vertices_within(camera, points, surface, through);
    }
};

/// Of a convex body: a vertex is seen where one of its faces turns to the eye. Faces seen almost edge-on are
/// left open, rounding decides there.
std::vector<int> seen_of_convex(const Mesh& mesh, const OrbitCamera& camera) {
    std::vector<int> seen(mesh.vertex_count(), -1);
    for (const Triangle& t : mesh.triangles) {
        const Vec3& a = mesh.positions[t[0]];
        const Vec3 normal = glm::normalize(glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
        const Vec3 to_eye = camera.orthographic ? -camera.forward() : glm::normalize(camera.eye() - a);
        const double facing = glm::dot(normal, to_eye);
        for (const uint32_t v : t) {
            seen[v] = std::max(seen[v], facing > 1e-4 ? 1 : facing > -1e-4 ? 0 : -1);
        }
    }
    return seen;
}

Selection of(const Mesh& mesh, const std::vector<uint32_t>& vertices) {
    Selection selection;
    selection.reset(mesh.vertex_count());
    selection.change(vertices, SelectMode::replace);
    return selection;
}

/// The vertices that share a face with one of these, and these.
std::set<uint32_t> neighbours(const Mesh& mesh, const std::set<uint32_t>& vertices) {
    std::set<uint32_t> result = vertices;
    for (const Triangle& t : mesh.triangles) {
        if (vertices.count(t[0]) + vertices.count(t[1]) + vertices.count(t[2]) > 0) {
            result.insert(t.begin(), t.end());
        }
    }
    return result;
}

std::set<uint32_t> set_of(const Selection& selection) {
    const std::vector<uint32_t> vertices = selection.selected_vertices();
    return {vertices.begin(), vertices.end()};
}

InputEvent mouse(InputEvent::Kind kind, double x = 0, double y = 0, Modifiers held = {}) {
    InputEvent event;
    event.kind = kind;
    event.x = x;
    event.y = y;
    event.modifiers = held;
    return event;
}

} // namespace

TEST_CASE("a box over a ball takes what the eye sees, or all that is behind it too") {
    for (const bool orthographic : {false, true}) {
        const Ball ball(orthographic);
        const std::vector<int> seen = seen_of_convex(ball.mesh, ball.camera);
        const auto visible = ball.within({{400, 300}, {620, 300}, {620, 500}, {400, 500}}, false);
        const auto through = ball.within({{400, 300}, {620, 300}, {620, 500}, {400, 500}}, true);
        size_t in_box = 0;
        for (uint32_t v = 0; v < ball.mesh.vertex_count(); ++v) {
            const ScreenPoint at = ball.camera.project(ball.mesh.positions[v]);
            const bool inside = at.x > 400 && at.x < 620 && at.y > 300 && at.y < 500;
            in_box += inside ? 1 : 0;
            const bool taken = std::binary_search(visible.begin(), visible.end(), v);
            CHECK(std::binary_search(through.begin(), through.end(), v) == inside);
            if (seen[v] != 0) {
                CHECK(taken == (inside && seen[v] > 0));
            }
        }
        CHECK(through.size() == in_box);
        CHECK(visible.size() > 20);
        CHECK(visible.size() < in_box);
    }
}

TEST_CASE("a lasso takes what lies within it, hollows left out") {
    const std::vector<Cursor> hook{{0, 0}, {10, 0}, {10, 10}, {6, 10}, {6, 4}, {4, 4}, {4, 10}, {0, 10}};
    CHECK(within(hook, 2, 8));
    CHECK(within(hook, 8, 8));
    CHECK(within(hook, 5, 2));
    CHECK_FALSE(within(hook, 5, 7)); // between the arms
    CHECK_FALSE(within(hook, 11, 5));
    CHECK_FALSE(within(hook, -1, 5));
}

TEST_CASE("a click takes the vertex that it is at, or the face under it") {
    Ball ball;
    const auto face = vertices_under(ball.camera, {503, 407}, ball.surface);
    const ClosestPoint hit = ball.surface.first_hit(ball.camera.ray(503, 407));
    const Triangle& t = ball.mesh.triangles[hit.triangle];
    const ScreenPoint corner = ball.camera.project(ball.mesh.positions[t[0]]);
    if (face.size() == 3) {
        CHECK(std::set<uint32_t>(face.begin(), face.end()) == std::set<uint32_t>(t.begin(), t.end()));
    }
    CHECK(vertices_under(ball.camera, {corner.x + 2, corner.y + 1}, ball.surface) ==
          std::vector<uint32_t>{t[0]});
    CHECK(vertices_under(ball.camera, {2, 2}, ball.surface).empty());
    ball.camera.zoom(12, 500, 400); // a face is a hundred pixels wide
    const ScreenPoint middle = ball.camera.project(
        (ball.mesh.positions[t[0]] + ball.mesh.positions[t[1]] + ball.mesh.positions[t[2]]) / 3.0);
    CHECK(vertices_under(ball.camera, {middle.x, middle.y}, ball.surface).size() == 3);
}

TEST_CASE("a selection grows by the faces at its rim, shrinks by those of the rest, and inverts") {
    const Mesh mesh = make_sample("icosphere", 642);
    Selection selection = of(mesh, {0, 17, 300});
    selection.grow(mesh);
    const std::set<uint32_t> once = neighbours(mesh, {0, 17, 300});
    CHECK(set_of(selection) == once);
    selection.grow(mesh);
    CHECK(set_of(selection) == neighbours(mesh, once));
    Selection shrunk = selection;
    shrunk.shrink(mesh);
    Selection rest = selection;
    rest.invert();
    rest.grow(mesh);
    rest.invert();
    CHECK(shrunk == rest); // what is left is what the others do not grow into
    CHECK(selection.selected_count() + [&] {
        Selection inverted = selection;
        inverted.invert();
        return inverted.selected_count();
    }() == mesh.vertex_count());
}

TEST_CASE("what is hidden is not selected by anything, and comes back selected") {
    const Mesh mesh = make_sample("icosphere", 642);
    Selection selection = of(mesh, {1, 2, 3});
    selection.hide_selected();
    CHECK(selection.selected_count() == 0);
    CHECK(selection.hidden_count() == 3);
    selection.change(std::vector<uint32_t>{2, 9}, SelectMode::add);
    CHECK(selection.selected_vertices() == std::vector<uint32_t>{9});
    selection.select_all();
    CHECK(selection.selected_count() == mesh.vertex_count() - 3);
    selection.invert();
    CHECK(selection.selected_count() == 0);
    selection.show_all();
    CHECK(selection.selected_vertices() == std::vector<uint32_t>{1, 2, 3});
    selection.hide_unselected();
    CHECK(selection.hidden_count() == mesh.vertex_count() - 3);
    CHECK(selection.selected_count() == 3);
    const std::array<uint32_t, 3> gone{10, 11, 12};
    const std::array<uint32_t, 3> rim{1, 11, 12};
    CHECK(selection.hides(gone));
    CHECK_FALSE(selection.hides(rim));
}

TEST_CASE("refinement leaves a selection as it is, and what it adds between selected vertices is selected") {
    Selection selection;
    selection.reset(4);
    selection.change(std::vector<uint32_t>{0, 1}, SelectMode::replace);
    const std::vector<VertexParents> once{{0, 1, 0.5}, {1, 2, 0.5}, {0, 4, 0.5}};
    selection.follow(7, {}, once);
    CHECK(selection.selected_vertices() == std::vector<uint32_t>{0, 1, 4, 6}); // 6 between 0 and 4
    selection.change(std::vector<uint32_t>{5}, SelectMode::add);
    selection.follow(7, once, once); // an edit that adds nothing
    CHECK(selection.selected_vertices() == std::vector<uint32_t>{0, 1, 4, 5, 6});
    const std::vector<VertexParents> other{{2, 3, 0.5}, {1, 2, 0.5}};
    selection.follow(6, once, other); // undone, and refined elsewhere
    CHECK(selection.selected_vertices() == std::vector<uint32_t>{0, 1, 5});
    selection.follow(4, other, {});
    CHECK(selection.selected_vertices() == std::vector<uint32_t>{0, 1});
}

TEST_CASE("selected faces are the recipe's faces, and what is left of a selection its vertices") {
    SurfaceVersion version = first_version(std::make_shared<const Mesh>(make_sample("icosphere", 642)));
    const PickSurface pick(*version.mesh, *version.history, version.positions);
    const Triangle& face = version.mesh->triangles[77];
    const Selection selection = of(*version.mesh, {face[0], face[1], face[2], 600});
    const SelectedPlaces places = faces_and_places_of(version, selection, pick);
    REQUIRE(places.faces.size() == 1);
    CHECK(places.faces[0].at.face == 77);
    REQUIRE(places.places.size() == 1);
    CHECK(std::get<VertexAddress>(places.places[0].at).vertex == 600);
}

TEST_CASE("a press, a way and a release are a box or a lasso; modifiers add and take away") {
    OrbitCamera camera;
    SelectTool tool;
    tool.handle(mouse(InputEvent::Kind::move, 100, 100), camera);
    CHECK(tool.handle(mouse(InputEvent::Kind::press, 0, 0, {.shift = true}), camera));
    tool.handle(mouse(InputEvent::Kind::move, 150, 160), camera);
    CHECK(tool.outline().size() == 4);
    CHECK(tool.handle(mouse(InputEvent::Kind::release), camera));
    auto change = tool.take();
    REQUIRE(change);
    CHECK(change->mode == SelectMode::add);
    CHECK(change->outline.size() == 4);
    CHECK_FALSE(tool.take());
    tool.lasso = true;
    tool.handle(mouse(InputEvent::Kind::press, 0, 0, {.control = true}), camera);
    for (const double x : {160.0, 170.0, 165.0}) {
        tool.handle(mouse(InputEvent::Kind::move, x, x), camera);
    }
    tool.handle(mouse(InputEvent::Kind::release), camera);
    change = tool.take();
    REQUIRE(change);
    CHECK(change->mode == SelectMode::subtract);
    CHECK(change->outline.size() == 4);
    tool.handle(mouse(InputEvent::Kind::press), camera);
    tool.handle(mouse(InputEvent::Kind::release), camera);
    CHECK(tool.take()->outline.size() == 1); // a click
}

TEST_CASE("faces that are left out are not hit, and the others keep their numbers") {
    const Ball ball;
    const Ray ray = ball.camera.ray(510, 395);
    const uint32_t first = ball.surface.first_hit(ray).triangle;
    std::vector<uint32_t> others;
    for (uint32_t t = 0; t < ball.mesh.triangles.size(); ++t) {
        if (t != first) {
            others.push_back(t);
        }
    }
    const PickSurface open(ball.mesh, ball.history, ball.mesh.positions, others);
    const ClosestPoint through = open.first_hit(ray);
    REQUIRE(through.found());
    CHECK(through.triangle != first);
    CHECK(glm::dot(through.position, ball.camera.forward()) > 0); // the far side
    CHECK(glm::distance(through.position, position(ball.mesh, ball.mesh.positions,
                                                   {through.triangle, through.barycentric})) <= 1e-12);
}

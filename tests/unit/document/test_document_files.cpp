#include "tests/unit/document/session.h"

#include "engine/core/atomic_file.h"
#include "engine/core/read_file.h"
#include "engine/document/recipe_paths.h"
#include "engine/mesh/mesh_reader.h"

#include <filesystem>

using namespace anvil;
using namespace anvil::test;

namespace fs = std::filesystem;

namespace {

/// A ball from a mesh file of its own, that is part of a union.
Occluder ball_of_file(const fs::path& file) {
    CsgShape both;
    both.parts.push_back({"file", {MeshShape{file.string()}}, {}});
    both.parts.push_back({"beside", {SphereShape{0.1}}, {Vec3(0.5, 0, 0)}});
    Occluder occluder;
    occluder.name = "ball";
    occluder.shape.solid = both;
    occluder.transform.translate = Vec3(0, 1.35, 0);
    occluder.transform.scale = 0.3;
    occluder.field = Field{FieldKind::adaptive, 16};
    return occluder;
}

std::string file_in(const Recipe& recipe) {
    const auto& csg = std::get<CsgShape>(recipe.occluders.at(0).shape.solid);
    return std::get<MeshShape>(csg.parts.at(0).shape.solid).file;
}

} // namespace

TEST_CASE("the saved recipe, forged, gives the session's mesh, and the session writes forge's bytes") {
    Session s;
    const auto document = s.open();
    for (const Recipe& next : s.story(document->recipe())) {
        document->change(next, "Step", s.work);
    }
    CHECK(document->unsaved());
    document->save_recipe(s.folder / "story.json");
    CHECK_FALSE(document->unsaved());
    document->save_mesh(s.folder / "session.ply");

    const Recipe saved = read_recipe(s.folder / "story.json");
    CHECK(saved.mesh == "sphere.ply");
    const Mesh mesh = read_mesh(mesh_path(saved), s.log);
    const ForgeResult result = forged(mesh, saved, *s.backend, s.log);
    CHECK(result.positions == document->surface()->positions);
    write_edited_mesh(s.folder / "forged.ply", result.refined ? *result.refined : mesh, result.positions,
                      result.moved);
    CHECK(read_file(s.folder / "session.ply") == read_file(s.folder / "forged.ply"));

    const auto again = Document::open(s.folder / "story.json", s.work);
    CHECK(again->surface()->positions == document->surface()->positions);
    CHECK_FALSE(again->unsaved());
}

TEST_CASE("files are named relative to the recipe wherever it is saved, in occluders too") {
    Session s;
    const Mesh tool = make_sample("icosphere", 162);
    fs::create_directories(s.folder / "tools");
    write_mesh(s.folder / "tools/ball.ply", tool, tool.positions);
    const auto document = s.open();
    Recipe recipe = document->recipe();
    recipe.occluders.push_back(ball_of_file(s.folder / "tools/ball.ply"));
    recipe.edits.push_back(with_poses(recipe, pull(Vec3(0, 1, 0), 0.2)));
    document->change(recipe, "Pull at the ball", s.work);
    const std::vector<Vec3> pulled = document->surface()->positions;

    fs::create_directories(s.folder / "a/b");
    for (const char* place : {"here.json", "a/b/deep.json"}) {
        document->save_recipe(s.folder / place);
        const Recipe saved = read_recipe(s.folder / place);
        const std::string up = std::string(place) == "here.json" ? "" : "../../";
        CHECK(saved.mesh == up + "sphere.ply");
        CHECK(file_in(saved) == up + "tools/ball.ply");
        const auto again = Document::open(s.folder / place, s.work);
        CHECK(again->surface()->positions == pulled);
        CHECK(fs::path(file_in(again->recipe())).is_absolute());
    }
    document->undo(s.work);
    document->redo(s.work);
    CHECK_FALSE(document->unsaved());

    // All of it moved elsewhere, together.
    Session elsewhere;
    fs::copy(s.folder.path(), elsewhere.folder / "moved", fs::copy_options::recursive);
    const auto moved = Document::open(elsewhere.folder / "moved/a/b/deep.json", elsewhere.work);
    CHECK(moved->surface()->positions == pulled);
    CHECK(moved->mesh_file() == (elsewhere.folder / "moved/sphere.ply"));
}

TEST_CASE("a mesh that is not where the recipe says is asked for, and found anew") {
    Session s;
    const auto document = s.open();
    Recipe recipe = document->recipe();
    recipe.edits.push_back(pull(Vec3(0, 1, 0), 0.2));
    document->change(recipe, "Pull", s.work);
    document->save_recipe(s.folder / "pull.json");
    fs::create_directories(s.folder / "other");
    fs::rename(s.mesh, s.folder / "other/ball.ply");
    try {
        Document::open(s.folder / "pull.json", s.work);
        FAIL("the mesh is missing");
    } catch (const MissingMesh& missing) {
        CHECK(missing.mesh() == s.mesh);
        CHECK(std::string(missing.what()).find("pull.json") != std::string::npos);
    }
    const auto found = Document::open(s.folder / "pull.json", s.work, {}, s.folder / "other/ball.ply");
    CHECK(found->surface()->positions == document->surface()->positions);
    CHECK(found->unsaved());
    found->save_recipe(s.folder / "pull.json");
    CHECK(read_recipe(s.folder / "pull.json").mesh == "other/ball.ply");
}

TEST_CASE("nothing that the recipe reads is overwritten") {
    Session s;
    const Mesh tool = make_sample("icosphere", 162);
    write_mesh(s.folder / "ball.ply", tool, tool.positions);
    const auto document = s.open();
    Recipe recipe = document->recipe();
    recipe.occluders.push_back(ball_of_file(s.folder / "ball.ply"));
    document->change(recipe, "Add", s.work);
    document->save_recipe(s.folder / "recipe.json");
    const std::string mesh = read_file(s.mesh);
    CHECK_THROWS_AS(document->save_mesh(s.mesh), InputError);
    CHECK_THROWS_AS(document->save_mesh(s.folder / "../" / s.folder.path().filename() / "ball.ply"),
                    InputError);
    CHECK_THROWS_AS(document->save_recipe(s.mesh), InputError);
    CHECK_THROWS_AS(document->save_mesh(s.folder / "mesh.unknown"), InputError);
    CHECK_THROWS_AS(document->save_mesh(s.folder / "no/such/folder.ply"), WriteError);
    CHECK(read_file(s.mesh) == mesh);
    CHECK(document->recipe_file() == s.folder / "recipe.json");
}

TEST_CASE("a recipe's error on opening names its file") {
    Session s;
    write_file_atomically(
        s.folder / "bad.json",
        std::string_view(R"({"anvil": 1, "mesh": "sphere.ply", "edits": [{"kind": "translate",
        "handles": [{"at": {"vertex": 123456}, "by": [0, 0, 1]}]}]})"));
    CHECK_THROWS_WITH(Document::open(s.folder / "bad.json", s.work),
                      Catch::Contains("bad.json: edits[0].handles[0].at") && Catch::Contains("123456"));
}

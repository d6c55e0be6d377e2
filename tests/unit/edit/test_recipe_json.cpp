#include "tests/unit/edit/recipe_texts.h"

#include <filesystem>
#include <fstream>
#include <locale>

using namespace anvil;
using namespace anvil::recipe_texts;

TEST_CASE("a recipe that uses every key is read into the structs it names") {
    const Recipe recipe = parse(full_recipe);
    CHECK(recipe.file == "r.json");
    CHECK(recipe.mesh == "hand.ply");
    REQUIRE(recipe.occluders.size() == 9);
    CHECK(std::get<SphereShape>(recipe.occluders[0].shape.solid).radius == 0.04);
    CHECK(recipe.occluders[0].transform == Transform{{0.1, 0, -3e-5}, {0, 0, 1}, 30, 2});
    CHECK(recipe.occluders[0].influence == Influence{InfluenceKind::soft, 0.7, 0.002, {}, 0});
    CHECK(std::get<BoxShape>(recipe.occluders[1].shape.solid) == BoxShape{{1, 2, 3}, 0.25});
    CHECK(recipe.occluders[1].field == Field{FieldKind::dense, 64});
    CHECK(recipe.occluders[3].influence == Influence{});
    CHECK(recipe.occluders[6].influence.kind == InfluenceKind::curve);
    CHECK_FALSE(recipe.occluders[6].influence.knots[0].right.has_value());
    CHECK(recipe.occluders[6].influence.knots[1].left == -0.5);
    const auto& mould = std::get<CsgShape>(recipe.occluders[7].shape.solid);
    CHECK(mould.operation == CsgOperation::subtract);
    REQUIRE(mould.parts.size() == 2);
    CHECK(mould.parts[1].name == "hole");
    CHECK(mould.parts[1].transform.translate == Vec3(0, 1, 0));

    REQUIRE(recipe.edits.size() == 3);
    const Edit& first = recipe.edits[0];
    CHECK(std::get<VertexAddress>(first.handles[0].at).vertex == 1082);
    CHECK(first.handles[0].by == Vec3(0, -0.05, 0));
    CHECK(first.handles[1].to == Vec3(0.1, 0.3, 0));
    CHECK(first.handles[1].radius == 0.1);
    CHECK(first.handles[1].shape->preset == "crater");
    CHECK(first.handles[1].metric == Metric::geodesic);
    CHECK(std::get<FaceAddress>(first.handles[2].at) == FaceAddress{12, 1, {0.2, 0.3, 0.5}});
    CHECK(first.anchors[0].at.size() == 2);
    CHECK_FALSE(first.anchors[0].smooth_width.has_value());
    const auto& line = std::get<PolylineAddress>(first.anchors[1].at[0]);
    REQUIRE(line.points.size() == 3);
    CHECK(std::get<NearestAddress>(line.points[1]).point == Vec3(1, 2, 0.1));
    CHECK(std::get<WholeFaceAddress>(first.anchors[1].at[1]).face == 3);
    CHECK(first.anchors[1].smooth_width == 0.015);
    CHECK(first.smooth_surface == 12);
    CHECK(first.metric == Metric::euclidean);
    CHECK(first.method == DistanceMethod::approximate);
    CHECK(first.occluders->at(1).influence->kind == InfluenceKind::hard);
    CHECK_FALSE(first.occluders->at(0).transform.has_value());
    CHECK(first.steps == Steps{true, 4096});
    CHECK(first.least_squares);
    CHECK(first.amount == 0.25);
    CHECK(first.pinned.size() == 1);

    const Edit& second = recipe.edits[1];
    CHECK(second.kind == EditKind::rotate);
    CHECK(second.sweep == Sweep::chord);
    CHECK(second.axis == Axis{{0, 0, 1}, {0, 3, 0}});
    CHECK(second.handles[0].degrees == 720);
    CHECK(second.steps == Steps{false, 64});
    CHECK(second.shape.preset.empty());
    CHECK(second.shape.knots[1] == Knot{0.5, 0.4, -2, 0});
    CHECK(recipe.edits[2].occluders->empty());
}

TEST_CASE("what a recipe leaves out has the published default") {
    const Recipe recipe = parse(minimal());
    const Edit& edit = recipe.edits[0];
    CHECK(edit.metric == Metric::geodesic);
    CHECK(edit.method == DistanceMethod::automatic);
    CHECK(edit.shape == ShapeChoice{"smooth", {}});
    CHECK(edit.amount == 1);
    CHECK_FALSE(edit.least_squares);
    CHECK_FALSE(edit.radius.has_value());
    CHECK_FALSE(edit.occluders.has_value());
    CHECK_FALSE(edit.steps.has_value());
    CHECK(edit.smooth_surface == 0);
    CHECK(edit.sweep == Sweep::arc);
    CHECK(Influence{}.kind == InfluenceKind::soft);
    CHECK(Influence{}.strength == 0.9);
    CHECK(Field{}.resolution == 128);
}

TEST_CASE("a written recipe reads back equal, to the last bit") {
    Recipe recipe = parse(full_recipe);
    CHECK(parse(write_recipe(recipe)) == recipe);
    // 17 digits, the smallest and largest doubles, a negative zero.
    recipe.edits[0].handles[0].by = Vec3(0.1 + 0.2, -5e-324, 1.7976931348623157e308);
    recipe.edits[0].handles[1].to = Vec3(1.0 / 3, -0.0, 123456789012345678.0);
    const Recipe again = parse(write_recipe(recipe));
    CHECK(again == recipe);
    CHECK(std::signbit(again.edits[0].handles[1].to->y));
    CHECK(write_recipe(again) == write_recipe(recipe));
}

TEST_CASE("the minimal recipe survives writing too") {
    const Recipe recipe = parse(minimal());
    CHECK(parse(write_recipe(recipe)) == recipe);
    const Recipe none = parse(R"({"anvil": 1, "mesh": "a.ply", "edits": []})");
    CHECK(parse(write_recipe(none)) == none);
}

TEST_CASE("a recipe with a number that is not finite is not written") {
    Recipe recipe = parse(minimal());
    recipe.edits[0].amount = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(write_recipe(recipe), InternalError);
}

TEST_CASE("an edit without occluders uses all of them, an override replaces pose or influence as a whole") {
    const Recipe recipe = parse(full_recipe);
    Edit all = recipe.edits[0];
    all.occluders.reset();
    CHECK(occluders_of(recipe, all).size() == recipe.occluders.size());
    CHECK(occluders_of(recipe, recipe.edits[2]).empty());
    const auto uses = occluders_of(recipe, recipe.edits[0]);
    CHECK(uses[0].transform == recipe.occluders[0].transform);
    CHECK(uses[1].transform == Transform{{0, 1, 0}, {0, 1, 0}, 0, 1});
    CHECK(uses[1].influence->kind == InfluenceKind::hard);
}

TEST_CASE("the mesh lies relative to the recipe's folder") {
    CHECK(mesh_path(parse_recipe(minimal(), "some/folder/r.json")) == "some/folder/a.ply");
    CHECK(mesh_path(parse_recipe(minimal(), "r.json")) == "a.ply");
    CHECK(mesh_path(parse_recipe(replaced(minimal(), "a.ply", "/x/a.ply"), "f/r.json")) == "/x/a.ply");
}

TEST_CASE("a byte order mark and any locale change nothing") {
    CHECK(parse("\xef\xbb\xbf" + minimal()) == parse(minimal()));
    const char* before = std::setlocale(LC_ALL, nullptr);
    const std::string saved = before ? before : "C";
    if (std::setlocale(LC_ALL, "de_DE.UTF-8")) {
        const Recipe recipe = parse(full_recipe);
        CHECK(recipe.edits[0].radius == 0.2);
        CHECK(parse(write_recipe(recipe)) == recipe);
    }
    std::setlocale(LC_ALL, saved.c_str());
}

TEST_CASE("a recipe file that cannot be read is named") {
    const auto folder = std::filesystem::temp_directory_path() / "anvil_recipe_test.json";
    std::filesystem::remove_all(folder);
    CHECK_THROWS_WITH(read_recipe(folder), Catch::Contains(folder.string()) && Catch::Contains("no such"));
    std::filesystem::create_directory(folder);
    CHECK_THROWS_WITH(read_recipe(folder), Catch::Contains("folder"));
    const auto file = folder / "r.json";
    std::ofstream(file) << minimal();
    const Recipe recipe = read_recipe(file);
    CHECK(recipe.file == file.string());
    CHECK(mesh_path(recipe) == folder / "a.ply");
    std::filesystem::remove_all(folder);
}

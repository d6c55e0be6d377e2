#include "app/viewer/panels/curve_editor.h"
#include "engine/core/error.h"
#include "engine/edit/recipe_json.h"
#include "engine/edit/shape_file.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <fstream>

using namespace anvil;
namespace fs = std::filesystem;

namespace {

ShapeChoice crooked() {
    ShapeChoice shape = with_own_knots({"smooth", {}});
    const size_t knot = add_knot(shape, 0.4);
    move_knot(shape, knot, 0.37, 1.0 / 3);
    turn_slope(shape.knots[knot], true, -0.7, true);
    turn_slope(shape.knots[knot], false, 0.1, true);
    return shape;
}

} // namespace

TEST_CASE("a curve that is saved is found by its name and read as it was, kinks and digits") {
    const ScratchFolder scratch;
    const fs::path folder = fs::path(scratch / "curves");
    const ShapeChoice shape = crooked();
    CHECK(curves_in(folder).empty()); // not even there
    save_curve(shape, curve_file("my crease", folder));
    save_curve({"rim", {}}, curve_file("a rim", folder));
    CHECK(curves_in(folder) == std::vector<std::string>{"a rim", "my crease"});
    CHECK(read_shape_file(curve_file("my crease", folder)) == shape);
    CHECK(read_shape_file(curve_file("a rim", folder)) == ShapeChoice{"rim", {}});
    CHECK(curve_file(scratch / "x.json", folder) == fs::path(scratch / "x.json"));
    CHECK_THROWS_AS(curve_file("", folder), InputError);
    CHECK_THROWS_AS(curve_file("name", std::nullopt), InputError);
}

TEST_CASE("a curve's file is what recipes say of a shape") {
    const ScratchFolder scratch;
    const ShapeChoice shape = crooked();
    write_shape_file(scratch / "curve.json", shape);
    std::ifstream stream(scratch / "curve.json");
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const Recipe recipe = parse_recipe(
        R"({"anvil": 1, "mesh": "m.ply", "edits": [{"kind": "translate", "handles": [{"at": {"vertex": 0},
        "by": [0,1,0]}], "shape": )" +
            text + "}]}",
        "recipe.json");
    CHECK(recipe.edits[0].shape == shape);
}

TEST_CASE("a file that is no curve says where and why") {
    CHECK_THROWS_WITH(parse_shape(R"({"knots": [{"t": 0, "value": 1}, {"t": 1, "value": 0.5}]})", "c.json"),
                      Catch::Contains("c.json"));
    CHECK_THROWS_WITH(parse_shape(R"("smoth")", "c.json"), Catch::Contains("smooth"));
    CHECK_THROWS_WITH(parse_shape(R"({"knot": []})", "c.json"), Catch::Contains("knots"));
    CHECK_THROWS_AS(read_shape_file("/nonexistent/curve.json"), InputError);
}

TEST_CASE("slopes turn together until a kink parts them") {
    Knot knot{0.5, 0.5, 1.0, 1.0};
    turn_slope(knot, true, -2, false);
    CHECK(knot == Knot{0.5, 0.5, -2.0, -2.0});
    turn_slope(knot, false, 3, true);
    CHECK(knot == Knot{0.5, 0.5, -2.0, 3.0});
    turn_slope(knot, true, 0, false); // parted: they stay so
    CHECK(knot == Knot{0.5, 0.5, 0.0, 3.0});
}

TEST_CASE("knots of an influence stay within what recipes allow") {
    ShapeChoice shape = with_own_knots({"smooth", {}});
    move_knot(shape, 0, 0, 7, 1);
    CHECK(shape.knots[0].value == 1);
    move_knot(shape, 0, 0, -7, 1);
    CHECK(shape.knots[0].value == -1);
}

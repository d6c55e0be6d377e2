#include "engine/core/error.h"
#include "engine/edit/recipe_json.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <locale>
#include <string>

using namespace anvil;

namespace {

// Every key that this version knows.
const std::string full_recipe = R"({
  "anvil": 1, "mesh": "hand.ply",
  "occluders": [
    {"name": "ball", "shape": {"sphere": {"radius": 0.04}},
     "transform": {"translate": [0.1, 0, -3e-5], "rotate": {"axis": [0, 0, 1], "degrees": 30}, "scale": 2},
     "influence": {"kind": "soft", "strength": 0.7, "sigma": 0.002}},
    {"name": "block", "shape": {"box": {"half": [1, 2, 3], "rounding": 0.25}},
     "field": {"kind": "dense", "resolution": 64}, "influence": {"kind": "hard"}},
    {"name": "tube", "shape": {"cylinder": {"radius": 1, "height": 2}}, "field": {"kind": "exact"}},
    {"name": "pill", "shape": {"capsule": {"radius": 1, "height": 2}}},
    {"name": "spike", "shape": {"cone": {"radius": 1, "height": 2}}},
    {"name": "ring", "shape": {"torus": {"major": 2, "minor": 0.5}}},
    {"name": "floor", "shape": {"plane": {"normal": [0, 2, 0], "offset": -1}},
     "influence": {"knots": [{"t": 0, "value": 1}, {"t": 1, "value": 0, "left": -0.5}], "width": 0.1}},
    {"name": "mould", "shape": {"subtract": [
        {"shape": {"box": {"half": [1, 1, 1]}}},
        {"name": "hole", "shape": {"union": [{"shape": {"sphere": {"radius": 0.5}}},
            {"shape": {"intersection": [{"shape": {"plane": {"normal": [1, 0, 0]}}},
                                        {"shape": {"torus": {"major": 1, "minor": 1}}}]}}]},
         "transform": {"translate": [0, 1, 0]}}]},
     "field": {"kind": "dense"}},
    {"name": "old", "shape": {"sphere": {"radius": 1}}, "influence": {"kind": "paper"}}],
  "edits": [
    {"kind": "translate",
     "handles": [{"at": {"vertex": 1082}, "by": [0, -0.05, 0]},
                 {"at": {"nearest": [0.1, 0.2, 0]}, "to": [0.1, 0.3, 0], "radius": 0.1, "shape": "crater",
                  "metric": "geodesic"},
                 {"at": {"face": 12, "triangle": 1, "barycentric": [0.2, 0.3, 0.5]}, "by": [1, 2, 3]}],
     "anchors": [{"handle": 0, "at": [{"vertex": 5}, {"face": 3, "barycentric": [0, 0, 1]}], "blend": "min"}],
     "metric": "euclidean", "method": "approximate", "radius": 0.2, "shape": "smooth",
     "occluders": ["ball", {"name": "floor", "transform": {"translate": [0, 1, 0]}, "influence": {"kind": "hard"}}],
     "steps": {"max": 4096}, "least_squares": true, "amount": 0.25, "pinned": [{"vertex": 0}]},
    {"kind": "rotate", "axis": {"origin": [0, 0, 1], "direction": [0, 3, 0]}, "sweep": "chord",
     "handles": [{"at": {"vertex": 7}, "degrees": 720}, {"at": {"vertex": 8}, "to": [1, 0, 0]}],
     "radius": 0.3, "method": "auto", "occluders": ["old"], "steps": {"count": 64},
     "shape": {"knots": [{"t": 0, "value": 1, "tangent": 0}, {"t": 0.5, "value": 0.4, "left": -2, "right": 0},
                         {"t": 1, "value": 0, "tangent": 0}]}},
    {"kind": "translate", "handles": [{"at": {"vertex": 1}, "by": [1, 0, 0]}], "occluders": []}]})";

std::string minimal(const std::string& edit_extra = "", const std::string& occluders = "") {
    return R"({"anvil": 1, "mesh": "a.ply", )" + occluders +
           R"("edits": [{"kind": "translate", "handles": [{"at": {"vertex": 0}, "by": [1, 0, 0]}])" +
           edit_extra + "}]}";
}

Recipe parse(const std::string& text) {
    return parse_recipe(text, "r.json");
}

std::string complaint(const std::string& text) {
    try {
        parse(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

// The message names the file and holds all the words.
void check_complaint(const std::string& text, const std::vector<std::string>& words) {
    const std::string message = complaint(text);
    INFO("recipe: " << text);
    INFO("message: " << message);
    CHECK(message.rfind("r.json: ", 0) == 0);
    for (const std::string& word : words) {
        INFO("wanted: " << word);
        CHECK(message.find(word) != std::string::npos);
    }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

std::string with_handle(const std::string& handle, const std::string& kind = "translate") {
    const std::string axis =
        kind == "rotate" ? R"("axis": {"origin": [0,0,0], "direction": [0,1,0]}, )" : std::string();
    return R"({"anvil": 1, "mesh": "a.ply", "edits": [{"kind": ")" + kind + R"(", )" + axis +
           R"("handles": [)" + handle + "]}]}";
}

std::string with_occluder(const std::string& rest) {
    return R"({"anvil": 1, "mesh": "a.ply", "occluders": [{"name": "o", )" + rest + R"(}], "edits": []})";
}

std::string with_shape(const std::string& shape) {
    return with_occluder("\"shape\": " + shape);
}

const std::string ball = R"("shape": {"sphere": {"radius": 1}})";

} // namespace

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

TEST_CASE("syntax errors name line and column") {
    check_complaint("{\n  \"anvil\": 1,\n  \"mesh\": oops\n}", {"line 3", "column 11", "not JSON"});
    check_complaint("", {"empty"});
    check_complaint("  \n ", {"empty"});
    check_complaint("{\"anvil\": 1", {"line 1", "not JSON"});
    check_complaint("{\"anvil\": 1,}", {"line 1, column 13"});
    check_complaint("{} {}", {"line 1, column 4"});
    check_complaint("{\"anvil\": NaN}", {"line 1"});
    check_complaint("ply\nformat ascii 1.0\n", {"line 1", "not JSON"});
    check_complaint("{\"a\": \"\xff\xfe\"}", {"line 1", "not JSON"});
    check_complaint(std::string("\0\0\0", 3), {"not JSON"});
}

TEST_CASE("every truncation of a recipe is a clear error") {
    for (size_t length = 0; length < full_recipe.size(); ++length) {
        const std::string message = complaint(full_recipe.substr(0, length));
        CHECK(message.rfind("r.json: ", 0) == 0);
    }
}

TEST_CASE("hostile nesting is refused and long names stay short in messages") {
    check_complaint(std::string(200000, '['), {"nested deeper than 100"});
    std::string deep = R"({"sphere": {"radius": 1}})";
    for (int i = 0; i < 60; ++i) {
        deep = R"({"union": [{"shape": )" + deep + "}]}";
    }
    check_complaint(with_shape(deep), {"nested deeper"});
    CHECK(complaint("{\"" + std::string(100000, 'x') + "\": 1}").size() < 400);
    CHECK(complaint(
              replaced(minimal(), "\"a.ply\"", "\"a.ply\", \"edits\": \"" + std::string(100000, 'x') + "\""))
              .size() < 400);
}

TEST_CASE("unknown keys name the nearest known key") {
    check_complaint(minimal(R"(, "raduis": 1)"),
                    {"edits[0].raduis", "unknown key", "did you mean \"radius\""});
    check_complaint(replaced(minimal(), "\"mesh\"", "\"Mesh\""), {"Mesh", "did you mean \"mesh\""});
    check_complaint(with_handle(R"({"at": {"vertx": 1}, "by": [0,0,0]})"),
                    {"edits[0].handles[0].at.vertx", "\"vertex\""});
    check_complaint(with_occluder(ball + R"(, "influense": {})"),
                    {"occluders[0].influense", "\"influence\""});
    check_complaint(with_shape(R"({"spere": {"radius": 1}})"), {"occluders[0].shape.spere", "\"sphere\""});
    check_complaint(with_shape(R"({"sphere": {"radius": 1, "height": 2}})"),
                    {"shape.sphere.height", "\"radius\""});
}

TEST_CASE("keys that occur twice are refused with their path") {
    check_complaint(minimal(R"(, "radius": 1, "radius": 2)"), {"edits[0].radius", "twice"});
    check_complaint(R"({"anvil": 1, "anvil": 1})", {"anvil", "twice"});
    check_complaint(
        with_handle(R"({"at": {"vertex": 1}, "by": [0,0,0]}, {"at": {"vertex": 1, "vertex": 2}})"),
        {"edits[0].handles[1].at.vertex", "twice"});
}

TEST_CASE("numbers beyond double are refused with their path") {
    check_complaint(minimal(R"(, "radius": 1e999)"), {"edits[0].radius", "1e999", "finite"});
    check_complaint(with_handle(R"({"at": {"vertex": 1}, "by": [0, -1e999, 0]})"),
                    {"edits[0].handles[0].by[1]", "-1e999"});
}

TEST_CASE("required keys are named when they are missing") {
    check_complaint("[]", {"must be an object"});
    check_complaint("{}", {"\"anvil\" is missing"});
    check_complaint(R"({"anvil": 1})", {"\"mesh\" is missing"});
    check_complaint(R"({"anvil": 1, "mesh": "a.ply"})", {"\"edits\" is missing"});
    check_complaint(R"({"anvil": 2, "mesh": "a.ply", "edits": []})", {"anvil", "found 2", "version 1"});
    check_complaint(R"({"anvil": 1, "mesh": "", "edits": []})", {"mesh", "path"});
    check_complaint(R"({"anvil": 1, "mesh": "a", "edits": [{}]})", {"edits[0]", "\"kind\" is missing"});
    check_complaint(R"({"anvil": 1, "mesh": "a", "edits": [{"kind": "translate"}]})",
                    {"edits[0]", "\"handles\" is missing"});
    check_complaint(with_handle(""), {"edits[0].handles", "at least one handle"});
    check_complaint(with_handle(R"({"by": [0,0,0]})"), {"edits[0].handles[0]", "\"at\" is missing"});
    check_complaint(with_occluder(R"("transform": {})"), {"occluders[0]", "\"shape\" is missing"});
    check_complaint(R"({"anvil": 1, "mesh": "a", "occluders": [{}], "edits": []})", {"\"name\" is missing"});
}

TEST_CASE("wrong types say what was found and what is wanted") {
    check_complaint(replaced(minimal(), "\"a.ply\"", "3"), {"mesh", "found 3", "text in quotes"});
    check_complaint(replaced(minimal(), "\"translate\"", "5"), {"edits[0].kind", "found 5", "\"rotate\""});
    check_complaint(replaced(minimal(), "\"translate\"", "\"scale\""), {"found \"scale\"", "\"translate\""});
    check_complaint(replaced(minimal(), "[1, 0, 0]", "[1, 0]"),
                    {"edits[0].handles[0].by", "found [1,0]", "[x, y, z]"});
    check_complaint(replaced(minimal(), "[1, 0, 0]", R"([1, "0", 0])"), {"by", "[x, y, z]"});
    check_complaint(replaced(minimal(), "[1, 0, 0]", "null"), {"by", "found null"});
    check_complaint(replaced(minimal(), R"({"vertex": 0})", "0"), {"handles[0].at", "found 0", "object"});
    check_complaint(minimal(R"(, "radius": "0.2")"), {"edits[0].radius", "found \"0.2\"", "number"});
    check_complaint(minimal(R"(, "least_squares": 1)"), {"least_squares", "true or false"});
    check_complaint(minimal(R"(, "pinned": {"vertex": 1})"), {"pinned", "list"});
    check_complaint(minimal(R"(, "metric": "manhattan")"), {"metric", "\"geodesic\"", "\"euclidean\""});
}

TEST_CASE("vertex indices are whole numbers that 32 bits hold") {
    for (const char* bad : {"-1", "1.5", "4294967295", "1e20", "\"7\"", "true"}) {
        check_complaint(replaced(minimal(), R"("vertex": 0)", R"("vertex": )" + std::string(bad)),
                        {"handles[0].at.vertex", "whole number"});
    }
    CHECK(complaint(replaced(minimal(), R"("vertex": 0)", R"("vertex": 7.0)")).empty());
}

TEST_CASE("points on the surface are given in exactly one way") {
    const auto at = [](const std::string& point) {
        return with_handle(R"({"by": [0,0,0], "at": )" + point + "}");
    };
    check_complaint(at("{}"), {"handles[0].at", "exactly one", "\"nearest\""});
    check_complaint(at(R"({"vertex": 1, "nearest": [0,0,0]})"), {"exactly one"});
    check_complaint(at(R"({"vertex": 1, "triangle": 0})"), {"at.triangle", "unknown key"});
    check_complaint(at(R"({"face": 1, "barycentric": [0.5, 0.6, 0]})"),
                    {"barycentric", "0.5,0.6,0", "sum to 1"});
    check_complaint(at(R"({"face": 1, "barycentric": [-0.1, 0.6, 0.5]})"), {"barycentric", "negative"});
    check_complaint(at(R"({"face": 1})"), {"whole face", "not yet", "barycentric"});
    check_complaint(at(R"({"polyline": [{"vertex": 9}]})"), {"polyline", "not yet"});
}

TEST_CASE("barycentrics within rounding of the triangle are accepted and brought to sum 1") {
    const Recipe recipe = parse(
        with_handle(R"({"at": {"face": 1, "barycentric": [-5e-10, 0.3333333, 0.6666667]}, "by": [0,0,0]})"));
    const auto& b = std::get<FaceAddress>(recipe.edits[0].handles[0].at).barycentric;
    CHECK(b[0] == 0);
    CHECK(b[0] + b[1] + b[2] == Approx(1).epsilon(1e-15));
    CHECK(parse(write_recipe(recipe)) == recipe);
}

TEST_CASE("a handle has one target that fits the kind of its edit") {
    const std::string at = R"("at": {"vertex": 1})";
    check_complaint(with_handle("{" + at + "}"), {"edits[0].handles[0]", "no target", "\"by\" or \"to\""});
    check_complaint(with_handle("{" + at + R"(, "by": [0,0,1], "to": [0,0,1]})"), {"both \"by\" and \"to\""});
    check_complaint(with_handle("{" + at + R"(, "degrees": 3})"), {"\"degrees\"", "translation", "\"by\""});
    check_complaint(with_handle("{" + at + R"(, "by": [0,0,1]})", "rotate"),
                    {"\"by\"", "rotation", "\"degrees\""});
    check_complaint(with_handle("{" + at + R"(, "degrees": 3, "to": [0,0,1]})", "rotate"),
                    {"both \"degrees\" and \"to\""});
    check_complaint(with_handle("{" + at + "}", "rotate"), {"no target", "\"degrees\" or \"to\""});
    check_complaint(with_handle("{" + at + R"(, "path": [[0,0,0]]})"), {"handles[0].path", "not yet"});
}

TEST_CASE("lengths and fractions outside their range are refused") {
    for (const char* bad : {"0", "-0.5"}) {
        check_complaint(minimal(R"(, "radius": )" + std::string(bad)),
                        {"edits[0].radius", bad, "greater than 0"});
        check_complaint(
            with_handle(R"({"at": {"vertex": 1}, "by": [0,0,0], "radius": )" + std::string(bad) + "}"),
            {"handles[0].radius", "greater than 0"});
        check_complaint(with_shape(R"({"sphere": {"radius": )" + std::string(bad) + "}}"),
                        {"occluders[0].shape.sphere.radius", "greater than 0"});
        check_complaint(with_occluder(ball + R"(, "influence": {"kind": "soft", "sigma": )" + bad + "}"),
                        {"influence.sigma", "greater than 0"});
        check_complaint(with_occluder(ball + R"(, "transform": {"scale": )" + bad + "}"),
                        {"transform.scale", "greater than 0"});
    }
    check_complaint(minimal(R"(, "amount": 1.5)"), {"amount", "1.5", "[0, 1]"});
    check_complaint(minimal(R"(, "amount": -0.1)"), {"amount", "[0, 1]"});
    check_complaint(with_occluder(ball + R"(, "influence": {"strength": 1.1})"), {"strength", "[0, 1]"});
    for (const char* bad : {"0", "-1", "1000001", "2.5"}) {
        check_complaint(minimal(R"(, "steps": {"count": )" + std::string(bad) + "}"),
                        {"edits[0].steps.count", bad, "1000000"});
        check_complaint(minimal(R"(, "steps": {"max": )" + std::string(bad) + "}"), {"edits[0].steps.max"});
    }
    check_complaint(minimal(R"(, "steps": {})"), {"steps", "\"count\"", "\"max\""});
    check_complaint(minimal(R"(, "steps": {"count": 1, "max": 2})"), {"steps", "either"});
}

TEST_CASE("rotations need their axis and translations have none") {
    const std::string rotate = R"({"anvil": 1, "mesh": "a", "edits": [{"kind": "rotate", AXIS
        "handles": [{"at": {"vertex": 7}, "degrees": 90}]}]})";
    check_complaint(replaced(rotate, "AXIS", ""), {"edits[0]", "rotation needs an \"axis\"", "direction"});
    check_complaint(replaced(rotate, "AXIS", R"("axis": {"origin": [0,0,0], "direction": [0,0,0]},)"),
                    {"edits[0].axis.direction", "zero"});
    check_complaint(replaced(rotate, "AXIS", R"("axis": {"direction": [0,1,0]},)"),
                    {"\"origin\" is missing"});
    check_complaint(minimal(R"(, "axis": {"origin": [0,0,0], "direction": [0,1,0]})"), {"axis", "rotation"});
    check_complaint(minimal(R"(, "sweep": "arc")"), {"sweep", "rotation"});
    check_complaint(with_occluder(ball + R"(, "transform": {"rotate": {"degrees": 30}})"),
                    {"occluders[0].transform.rotate", "axis"});
    check_complaint(with_occluder(ball + R"(, "transform": {"rotate": {"axis": [0,0,0], "degrees": 30}})"),
                    {"transform.rotate.axis", "zero"});
}

TEST_CASE("a non-uniform scale is refused with the reason") {
    check_complaint(with_occluder(ball + R"(, "transform": {"scale": [1, 2, 1]})"),
                    {"transform.scale", "[1,2,1]", "non-uniform"});
}

TEST_CASE("shape functions are checked where they stand") {
    check_complaint(minimal(R"(, "shape": "smoth")"), {"edits[0].shape", "smoth", "plateau", "crater"});
    check_complaint(minimal(R"(, "shape": {"knots": [{"t": 0, "value": 1}]})"),
                    {"edits[0].shape.knots", "2 to 256"});
    check_complaint(
        minimal(
            R"(, "shape": {"knots": [{"t": 0, "value": 1}, {"t": 0.6, "value": 1}, {"t": 0.5, "value": 0}]})"),
        {"edits[0].shape.knots[2].t", "must increase"});
    check_complaint(minimal(R"(, "shape": {"knots": [{"t": 0, "value": 1}, {"t": 1, "value": 1}]})"),
                    {"edits[0].shape.knots[1].value", "jump", "must be 0"});
    check_complaint(minimal(R"(, "shape": {"knots": [{"t": 0}]})"), {"knots[0]", "\"value\" is missing"});
    check_complaint(minimal(R"(, "shape": {"knots": [{"t": 0, "value": 1, "tangent": 0, "left": 1}]})"),
                    {"knots[0]", "both sides"});
    check_complaint(with_handle(R"({"at": {"vertex": 1}, "by": [0,0,0], "shape": "x"})"),
                    {"edits[0].handles[0].shape", "known are"});
}

TEST_CASE("anchors name an existing handle, once") {
    check_complaint(minimal(R"(, "anchors": [{"handle": 1, "at": [{"vertex": 1}]}])"),
                    {"edits[0].anchors[0].handle", "found 1", "0 to 0"});
    check_complaint(minimal(R"(, "anchors": [{"handle": 0, "at": []}])"), {"anchors[0].at", "at least one"});
    check_complaint(
        minimal(R"(, "anchors": [{"handle": 0, "at": [{"vertex": 1}]}, {"at": [{"vertex": 2}]}])"),
        {"anchors[1]", "already"});
    check_complaint(minimal(R"(, "anchors": [{"handle": 0, "at": [{"face": 3}]}])"),
                    {"anchors[0].at[0]", "whole face", "not yet"});
    check_complaint(minimal(R"(, "anchors": [{"at": [{"polyline": [{"vertex": 9}, {"vertex": 11}]}]}])"),
                    {"anchors[0].at[0].polyline", "not yet"});
    check_complaint(minimal(R"(, "anchors": [{"at": [{"vertex": 1}], "blend": {"smooth": 0.1}}])"),
                    {"anchors[0].blend", "not yet"});
}

TEST_CASE("keys of later versions say not yet") {
    check_complaint(minimal(R"(, "refine": {"criterion": "shape"})"), {"edits[0].refine", "not yet"});
    check_complaint(minimal(R"(, "smooth_surface": 3)"), {"smooth_surface", "not yet"});
    check_complaint(minimal(R"(, "mirror": {"axis": "x", "origin": 0})"), {"mirror", "not yet"});
    check_complaint(minimal(R"(, "dilation": {"form": "depth"})"), {"dilation", "not yet"});
    check_complaint(with_shape(R"({"vdb": "tool.vdb", "grid": "surface"})"), {"not yet"});
    check_complaint(with_occluder(ball + R"(, "field": {"kind": "adaptive"})"),
                    {"field.kind", "not yet", "dense"});
    check_complaint(with_occluder(ball + R"(, "motion": [])"), {"occluders[0].motion", "not yet"});
    check_complaint(minimal(R"(, "occluders": [{"name": "o", "motion": []}])",
                            R"("occluders": [{"name": "o", )" + ball + "}], "),
                    {"edits[0].occluders[0].motion", "not yet"});
}

TEST_CASE("occluder shapes are whole and sane") {
    check_complaint(with_shape("{}"), {"occluders[0].shape", "sphere"});
    check_complaint(with_shape("\"sphere\""), {"shape", "found \"sphere\"", "object"});
    check_complaint(with_shape(R"({"sphere": {"radius": 1}, "cone": {"radius": 1, "height": 1}})"),
                    {"several"});
    check_complaint(with_shape(R"({"box": {"half": [1, 0, 1]}})"), {"box.half", "greater than 0"});
    check_complaint(with_shape(R"({"box": {"half": [1, 2, 1], "rounding": 1.5}})"),
                    {"box.rounding", "[0, 1]"});
    check_complaint(with_shape(R"({"torus": {"major": 1, "minor": 2}})"), {"torus.minor", "exceed"});
    check_complaint(with_shape(R"({"plane": {"normal": [0, 0, 0]}})"), {"plane.normal", "zero"});
    check_complaint(with_shape(R"({"cylinder": {"radius": 1}})"),
                    {"shape.cylinder", "\"height\" is missing"});
    check_complaint(with_shape(R"({"union": []})"), {"shape.union", "at least one"});
    check_complaint(with_shape(R"({"union": [{"shape": {"sphere": {"radius": 1}}, "influence": {}}]})"),
                    {"union[0]", "influence", "whole occluder"});
    check_complaint(with_shape(R"({"union": [{"shape": {"sphere": {"radius": 1}}, "name": ""}], "x": 1})"),
                    {"shape.x", "unknown key"});
}

TEST_CASE("what is unbounded cannot be baked") {
    const std::string plane = R"({"shape": {"plane": {"normal": [0,1,0]}}})";
    const std::string sphere = R"({"shape": {"sphere": {"radius": 1}}})";
    const auto baked = [](const std::string& shape) {
        return with_occluder("\"shape\": " + shape + R"(, "field": {"kind": "dense"})");
    };
    for (const std::string& shape :
         {std::string(R"({"plane": {"normal": [0,1,0]}})"), R"({"union": [)" + sphere + ", " + plane + "]}",
          R"({"subtract": [)" + plane + ", " + sphere + "]}", R"({"intersection": [)" + plane + "]}"}) {
        check_complaint(baked(shape), {"occluders[0].field", "plane", "exact"});
        CHECK(complaint(with_shape(shape)).empty());
    }
    for (const std::string& shape : {R"({"intersection": [)" + plane + ", " + sphere + "]}",
                                     R"({"subtract": [)" + sphere + ", " + plane + "]}"}) {
        CHECK(complaint(baked(shape)).empty());
    }
    for (const char* bad : {"7", "1025", "64.5", "\"128\""}) {
        check_complaint(with_occluder(ball + R"(, "field": {"kind": "dense", "resolution": )" + bad + "}"),
                        {"field.resolution", "8 to 1024"});
    }
}

TEST_CASE("influences hold what their kind uses and stay in range") {
    const auto influence = [](const std::string& text) {
        return with_occluder(ball + R"(, "influence": )" + text);
    };
    check_complaint(influence(R"({"kind": "gentle"})"), {"influence.kind", "gentle", "\"soft\""});
    check_complaint(influence(R"({"kind": "hard", "sigma": 1})"), {"influence.sigma", "soft"});
    check_complaint(influence(R"({"kind": "paper", "strength": 1})"), {"influence.strength", "soft"});
    check_complaint(influence(R"({"width": 1})"), {"influence", "\"knots\" is missing"});
    const std::string knots = R"("knots": [{"t": 0, "value": 1}, {"t": 1, "value": 0}])";
    check_complaint(influence("{" + knots + "}"), {"\"width\" is missing"});
    check_complaint(influence("{" + knots + R"(, "width": 0})"), {"influence.width", "greater than 0"});
    check_complaint(influence(R"({"kind": "soft", )" + knots + R"(, "width": 1})"),
                    {"influence", "kind", "knots"});
    check_complaint(influence(R"({"knots": [{"t": 0, "value": 1.5}, {"t": 1, "value": 0}], "width": 1})"),
                    {"influence.knots", "[-1, 1]"});
    // Both knots are in range, the curve between them is not.
    check_complaint(
        influence(R"({"knots": [{"t": 0, "value": 1, "tangent": 5}, {"t": 1, "value": 0}], "width": 1})"),
        {"influence.knots", "[-1, 1]"});
    check_complaint(influence(R"({"knots": [{"t": 0, "value": 1}, {"t": 1, "value": 0.5}], "width": 1})"),
                    {"influence.knots[1].value", "must be 0"});
}

TEST_CASE("occluder names are unique and known") {
    const std::string two =
        R"("occluders": [{"name": "ball", )" + ball + R"(}, {"name": "cup", )" + ball + "}], ";
    check_complaint(minimal(R"(, "occluders": ["bell"])", two),
                    {"edits[0].occluders[0]", "bell", "\"ball\", \"cup\""});
    check_complaint(minimal(R"(, "occluders": [{"name": "bell"}])", two), {"bell", "\"ball\""});
    check_complaint(minimal(R"(, "occluders": ["bell"])"), {"bell", "no \"occluders\""});
    check_complaint(replaced(minimal("", two), "\"cup\"", "\"ball\""),
                    {"occluders[1].name", "ball", "another"});
    check_complaint(replaced(minimal("", two), "\"cup\"", "\"\""), {"occluders[1].name", "empty"});
}

TEST_CASE("paper shares an edit with no other influence") {
    const std::string two = R"("occluders": [{"name": "a", )" + ball + R"(, "influence": {"kind": "paper"}},
                                             {"name": "b", )" +
                            ball + "}], ";
    check_complaint(minimal("", two), {"edits[0]", "paper", "mixed"});
    CHECK(complaint(minimal(R"(, "occluders": ["a"])", two)).empty());
    CHECK(complaint(minimal(R"(, "occluders": ["b"])", two)).empty());
    CHECK(complaint(minimal(R"(, "occluders": ["a", {"name": "b", "influence": {"kind": "paper"}}])", two))
              .empty());
    check_complaint(minimal(R"(, "occluders": ["a", {"name": "a", "influence": {"kind": "hard"}}])", two),
                    {"mixed"});
    check_complaint(minimal(R"(, "occluders": ["a"], "steps": {"max": 9})", two),
                    {"steps", "paper", "count"});
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

TEST_CASE("A mesh is an occluder's shape by its file, baked densely unless it is part of nothing exact") {
    const Recipe recipe = parse_recipe(with_shape(R"({"mesh": "tool.obj"})"), "folder/recipe.json");
    CHECK(std::get<MeshShape>(recipe.occluders[0].shape.solid).file == "tool.obj");
    CHECK_FALSE(has_formula(recipe.occluders[0].shape));
    CHECK(field_of(recipe.occluders[0]).kind == FieldKind::dense);
    CHECK(recipe_folder(recipe) == "folder");
    CHECK(parse_recipe(write_recipe(recipe), "folder/recipe.json") == recipe);
    check_complaint(with_shape(R"({"mesh": ""})"), {"occluders[0].shape.mesh", "path of a mesh file"});
    check_complaint(with_occluder(R"("shape": {"mesh": "tool.obj"}, "field": {"kind": "exact"})"),
                    {"field", "no formula", "dense"});
}

#include "tests/unit/edit/recipe_texts.h"

using namespace anvil;
using namespace anvil::recipe_texts;

TEST_CASE("a non-uniform scale is refused with the reason") {
    check_complaint(with_occluder(ball + R"(, "transform": {"scale": [1, 2, 1]})"),
                    {"transform.scale", "[1,2,1]", "non-uniform"});
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

TEST_CASE("A mesh is an occluder's shape by its file, baked adaptively unless the recipe says densely") {
    const Recipe recipe = parse_recipe(with_shape(R"({"mesh": "tool.obj"})"), "folder/recipe.json");
    CHECK(std::get<MeshShape>(recipe.occluders[0].shape.solid).file == "tool.obj");
    CHECK_FALSE(has_formula(recipe.occluders[0].shape));
    CHECK(field_of(recipe.occluders[0]).kind == FieldKind::adaptive);
    CHECK(recipe_folder(recipe) == "folder");
    CHECK(parse_recipe(write_recipe(recipe), "folder/recipe.json") == recipe);
    check_complaint(with_shape(R"({"mesh": ""})"), {"occluders[0].shape.mesh", "path of a mesh file"});
    check_complaint(with_occluder(R"("shape": {"mesh": "tool.obj"}, "field": {"kind": "exact"})"),
                    {"field", "no formula", "adaptive"});
    for (const auto& [name, kind] :
         {std::pair{"dense", FieldKind::dense}, std::pair{"adaptive", FieldKind::adaptive}}) {
        const Recipe baked =
            parse_recipe(with_occluder(R"("shape": {"mesh": "tool.obj"}, "field": {"kind": ")" +
                                       std::string(name) + R"(", "resolution": 64})"),
                         "folder/recipe.json");
        CHECK(baked.occluders[0].field == Field{kind, 64});
        CHECK(parse_recipe(write_recipe(baked), "folder/recipe.json") == baked);
    }
}

TEST_CASE("A level set is an occluder's shape by its file and, where it has several, its grid") {
    for (const char* shape : {R"({"vdb": "tool.vdb"})", R"({"vdb": "tool.vdb", "grid": "surface"})"}) {
        const Recipe recipe = parse_recipe(with_shape(shape), "folder/recipe.json");
        CHECK(std::get<VdbShape>(recipe.occluders[0].shape.solid).file == "tool.vdb");
        CHECK_FALSE(has_formula(recipe.occluders[0].shape));
        CHECK(parse_recipe(write_recipe(recipe), "folder/recipe.json") == recipe);
    }
    const Recipe named = parse(with_shape(R"({"vdb": "tool.vdb", "grid": "surface"})"));
    CHECK(std::get<VdbShape>(named.occluders[0].shape.solid).grid == "surface");
    check_complaint(with_shape(R"({"vdb": ""})"), {"occluders[0].shape.vdb", "path of a .vdb file"});
    check_complaint(with_shape(R"({"mesh": "tool.obj", "grid": "surface"})"), {"grid", "vdb"});
}

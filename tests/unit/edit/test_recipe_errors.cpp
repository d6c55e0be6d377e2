#include "tests/unit/edit/recipe_texts.h"

using namespace anvil;
using namespace anvil::recipe_texts;

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
                    {"edits[0]", "at least one handle", "\"motion\""});
    check_complaint(with_handle(""), {"edits[0]", "at least one handle"});
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

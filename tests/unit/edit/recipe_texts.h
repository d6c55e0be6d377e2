// Recipe texts and what the reader says of them.
#pragma once

#include "engine/core/error.h"
#include "engine/edit/recipe_json.h"

#include <catch2/catch.hpp>
#include <string>

namespace anvil::recipe_texts {

// Every key that this version knows.
inline const std::string full_recipe = R"({
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
     "anchors": [{"handle": 0, "at": [{"vertex": 5}, {"face": 3, "barycentric": [0, 0, 1]}], "blend": "min"},
                 {"handle": 2, "at": [{"polyline": [{"vertex": 9}, {"nearest": [1, 2, 0.1]},
                                                    {"face": 4, "barycentric": [0.5, 0.25, 0.25]}]},
                                      {"face": 3}], "blend": {"smooth": 0.015}}],
     "smooth_surface": 12,
     "metric": "euclidean", "method": "approximate", "radius": 0.2, "shape": "smooth",
     "occluders": ["ball", {"name": "floor", "transform": {"translate": [0, 1, 0]}, "influence": {"kind": "hard"}}],
     "steps": {"max": 4096}, "least_squares": true, "amount": 0.25, "pinned": [{"vertex": 0}]},
    {"kind": "rotate", "axis": {"origin": [0, 0, 1], "direction": [0, 3, 0]}, "sweep": "chord",
     "handles": [{"at": {"vertex": 7}, "degrees": 720}, {"at": {"vertex": 8}, "to": [1, 0, 0]}],
     "radius": 0.3, "method": "auto", "occluders": ["old"], "steps": {"count": 64},
     "shape": {"knots": [{"t": 0, "value": 1, "tangent": 0}, {"t": 0.5, "value": 0.4, "left": -2, "right": 0},
                         {"t": 1, "value": 0, "tangent": 0}]}},
    {"kind": "translate", "handles": [{"at": {"vertex": 1}, "by": [1, 0, 0]}], "occluders": []}]})";

inline std::string minimal(const std::string& edit_extra = "", const std::string& occluders = "") {
    return R"({"anvil": 1, "mesh": "a.ply", )" + occluders +
           R"("edits": [{"kind": "translate", "handles": [{"at": {"vertex": 0}, "by": [1, 0, 0]}])" +
           edit_extra + "}]}";
}

inline Recipe parse(const std::string& text) {
    return parse_recipe(text, "r.json");
}

inline std::string complaint(const std::string& text) {
    try {
        parse(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

// The message names the file and holds all the words.
inline void check_complaint(const std::string& text, const std::vector<std::string>& words) {
    const std::string message = complaint(text);
    INFO("recipe: " << text);
    INFO("message: " << message);
    CHECK(message.rfind("r.json: ", 0) == 0);
    for (const std::string& word : words) {
        INFO("wanted: " << word);
        CHECK(message.find(word) != std::string::npos);
    }
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

inline std::string with_handle(const std::string& handle, const std::string& kind = "translate") {
    const std::string axis =
        kind == "rotate" ? R"("axis": {"origin": [0,0,0], "direction": [0,1,0]}, )" : std::string();
    return R"({"anvil": 1, "mesh": "a.ply", "edits": [{"kind": ")" + kind + R"(", )" + axis +
           R"("handles": [)" + handle + "]}]}";
}

inline std::string with_occluder(const std::string& rest) {
    return R"({"anvil": 1, "mesh": "a.ply", "occluders": [{"name": "o", )" + rest + R"(}], "edits": []})";
}

inline std::string with_shape(const std::string& shape) {
    return with_occluder("\"shape\": " + shape);
}

inline const std::string ball = R"("shape": {"sphere": {"radius": 1}})";

} // namespace anvil::recipe_texts

#include "tests/app/refused_recipe.h"

#include <catch2/catch.hpp>
#include <filesystem>

using namespace anvil;

namespace {

std::string translate(const std::string& handle, const std::string& more = "") {
    return recipe_text(R"([{"kind": "translate", "radius": 0.8, "handles": [)" + handle + "]" + more + "}]");
}

std::string with_occluder(const std::string& more) {
    return recipe_text(pull_edit(), R"([{"name": "ball", )" + more + "}]");
}

const std::string ball = R"("shape": {"sphere": {"radius": 0.3}})";
const std::string good_handle = R"({"at": {"vertex": 3}, "by": [0, 0.1, 0]})";

const std::vector<RefusedRecipe> bad_recipes = {
    {"no JSON", "{\"anvil\": 1,\n \"mesh\" 2}", {"line 2"}},
    {"empty file", "", {}},
    {"a version to come", R"({"anvil": 2, "mesh": "mesh.ply", "edits": []})", {"anvil", "2"}},
    {"no mesh key", R"({"anvil": 1, "edits": []})", {"mesh"}},
    {"mesh file missing", R"({"anvil": 1, "mesh": "gone.ply", "edits": []})", {"gone.ply"}},
    {"unknown key", translate(good_handle, R"(, "raduis": 0.1)"), {"edits[0]", "raduis", "radius"}},
    {"unknown kind", recipe_text(R"([{"kind": "twist", "handles": []}])"), {"twist"}},
    {"vertex out of range",
     translate(R"({"at": {"vertex": 1002}, "by": [0, 1, 0]})"),
     {"1002", "handles[0]"}},
    {"negative vertex", translate(R"({"at": {"vertex": -1}, "by": [0, 1, 0]})"), {"-1", "handles[0]"}},
    {"fractional vertex", translate(R"({"at": {"vertex": 1.5}, "by": [0, 1, 0]})"), {"1.5"}},
    {"face out of range",
     translate(R"({"at": {"face": 2000, "barycentric": [1, 0, 0]}, "by": [0, 1, 0]})"),
     {"2000"}},
    {"barycentrics that do not sum to 1",
     translate(R"({"at": {"face": 0, "barycentric": [1, 1, 0]}, "by": [0, 1, 0]})"),
     {"barycentric"}},
    {"radius 0",
     recipe_text(R"([{"kind": "translate", "radius": 0, "handles": [)" + good_handle + "]}]"),
     {"radius"}},
    {"radius 0 of a handle", translate(R"({"at": {"vertex": 3}, "by": [0, 1, 0], "radius": 0})"), {"radius"}},
    {"negative radius",
     translate(R"({"at": {"vertex": 3}, "by": [0, 1, 0], "radius": -2})"),
     {"radius", "-2"}},
    {"NaN", translate(R"({"at": {"vertex": 3}, "by": [0, NaN, 0]})"), {}},
    {"a number beyond double", translate(R"({"at": {"vertex": 3}, "by": [0, 1e999, 0]})"), {}},
    {"two numbers for a vector", translate(R"({"at": {"vertex": 3}, "by": [0, 1]})"), {"by"}},
    {"neither by nor to", translate(R"({"at": {"vertex": 3}})"), {"by"}},
    {"both by and to", translate(R"({"at": {"vertex": 3}, "by": [0, 1, 0], "to": [0, 1, 0]})"), {"by", "to"}},
    {"no handles", recipe_text(R"([{"kind": "translate", "handles": []}])"), {"at least one handle"}},
    {"rotation without axis",
     recipe_text(R"([{"kind": "rotate", "radius": 1, "handles": [{"at": {"vertex": 3}, "degrees": 9}]}])"),
     {"axis"}},
    {"axis of no direction",
     recipe_text(R"([{"kind": "rotate", "radius": 1, "axis": {"origin": [0, 0, 0], "direction": [0, 0, 0]},
                      "handles": [{"at": {"vertex": 3}, "degrees": 9}]}])"),
     {"direction"}},
    {"two targets for one point",
     translate(R"({"at": {"vertex": 3}, "by": [0, 0.1, 0]}, {"at": {"vertex": 3}, "by": [0.1, 0, 0]})"),
     {"least_squares"}},
    {"a handle that no weight reaches",
     translate(good_handle, R"(, "anchors": [{"handle": 0, "at": [{"nearest": [0, -9, 0]}]}])"),
     {"handles[0]"}},
    {"anchors of no handle",
     translate(good_handle, R"(, "anchors": [{"handle": 1, "at": [{"vertex": 2}]}])"),
     {"anchors[0]"}},
    {"knots out of order",
     translate(good_handle, R"(, "shape": {"knots": [{"t": 0, "value": 1}, {"t": 0.6, "value": 0.5},
                                {"t": 0.4, "value": 0.2}, {"t": 1, "value": 0}]})"),
     {"shape"}},
    {"unknown preset", translate(good_handle, R"(, "shape": "pointy")"), {"pointy"}},
    {"amount beyond 1", translate(good_handle, R"(, "amount": 1.5)"), {"amount"}},
    {"occluder scaled to 0", with_occluder(ball + R"(, "transform": {"scale": 0})"), {"scale"}},
    {"occluder scaled non-uniformly",
     with_occluder(ball + R"(, "transform": {"scale": [1, 2, 1]})"),
     {"scale"}},
    {"sphere of radius 0", with_occluder(R"("shape": {"sphere": {"radius": 0}})"), {"radius"}},
    {"baked plane",
     with_occluder(R"("shape": {"plane": {"normal": [0, 1, 0], "offset": 0}},
                      "field": {"kind": "dense", "resolution": 32})"),
     {"plane"}},
    {"plane without normal",
     with_occluder(R"("shape": {"plane": {"normal": [0, 0, 0], "offset": 0}})"),
     {"normal"}},
    {"strength beyond 1",
     with_occluder(ball + R"(, "influence": {"kind": "soft", "strength": 2})"),
     {"strength"}},
    {"an edit's unknown occluder", translate(good_handle, R"(, "occluders": ["anvil"])"), {"anvil"}},
    {"a mirror without axis", translate(good_handle, R"(, "mirror": {"origin": 0})"), {"mirror", "axis"}},
};

} // namespace

TEST_CASE("A bad recipe is status 2, one line that says where and what, and no output is touched",
          "[app][forge]") {
    const ForgeFolder folder;
    folder.write("out.ply", "precious");
    for (const RefusedRecipe& bad : bad_recipes) {
        INFO(bad.what);
        check_refused(folder, bad);
        CHECK(content_of(folder.path("out.ply")) == "precious");
    }
}

TEST_CASE("forge refuses to overwrite what it reads, by whatever name, before any work", "[app][forge]") {
    const ForgeFolder folder;
    folder.write("pull.json", recipe_text(pull_edit()));
    std::filesystem::create_symlink(folder.path("mesh.ply"), folder.path("link.ply"));
    const std::string mesh = content_of(folder.path("mesh.ply"));
    const std::string recipe = content_of(folder.path("pull.json"));
    const std::vector<std::vector<std::string>> wrong = {
        {"-o", "mesh.ply"},
        {"-o", "./mesh.ply"},
        {"-o", folder.path("mesh.ply")},
        {"-o", "link.ply"},
        {"-o", "pull.json"},
        {"-o", "out.ply", "--image", "mesh.ply"},
        {"--report", "mesh.ply"},
        {"--report", "pull.json"},
        {"-o", "same", "--report", "same"},
        {"-o", "out.xyz"},
        {"-o", "out.ply", "--image", "out.jpg"},
        {"-o", "out.ply", "--size", "big", "--image", "out.png"},
    };
    for (const auto& arguments : wrong) {
        INFO(Catch::StringMaker<std::vector<std::string>>::convert(arguments));
        std::vector<std::string> all{"pull.json", "--device", "cpu"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const ProgramRun run = folder.forge(all);
        CHECK(run.status == 2);
        CHECK_THAT(run.err, Catch::StartsWith("anvil: error: "));
    }
    const bool untouched = content_of(folder.path("mesh.ply")) == mesh;
    CHECK(untouched);
    CHECK(content_of(folder.path("pull.json")) == recipe);
    CHECK_FALSE(folder.has("out.ply"));
}

TEST_CASE("A place that cannot be written is status 4, and nothing else was written before", "[app][forge]") {
    const ForgeFolder folder;
    folder.write("pull.json", recipe_text(pull_edit()));
    CHECK(folder.forge({"pull.json", "--device", "cpu", "-o", "nowhere/out.ply"}).status == 4);
    CHECK_FALSE(folder.has("nowhere"));
}

#include "tests/app/forge_folder.h"
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

using namespace anvil;

namespace {

constexpr const char* two_occluders = R"([
    {"name": "ball", "shape": {"sphere": {"radius": 0.5}}, "transform": {"translate": [1, 0, 0], "scale": 2}},
    {"name": "bite", "shape": {"subtract": [
        {"shape": {"box": {"half": [1, 1, 1]}}},
        {"shape": {"sphere": {"radius": 0.8}}, "transform": {"translate": [1, 1, 1]}}]},
     "field": {"kind": "dense", "resolution": 64}}])";

struct Bake {
    ScratchFolder folder;
    std::string recipe = write_recipe("recipe.json", two_occluders);
    std::string vdb = folder / "out.vdb";

    std::string write_recipe(const std::string& name, const std::string& occluders) const {
        const std::string file = folder / name;
        std::ofstream(file) << R"({"anvil": 1, "mesh": "none.ply", "edits": [], "occluders": )" << occluders
                            << "}";
        return file;
    }
    ProgramRun run(const std::vector<std::string>& arguments) const {
        std::vector<std::string> all{"bake", recipe};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return run_anvil(all);
    }
};

} // namespace

TEST_CASE("bake writes an occluder that probe finds again at the same place", "[app][bake]") {
    const Bake bake;
    const ProgramRun baked = bake.run({"-o", bake.vdb, "--occluder", "ball"});
    INFO(baked.err);
    REQUIRE(baked.status == 0);
    const std::string recipe = bake.write_recipe(
        "again.json", R"([{"name": "again", "shape": {"vdb": "out.vdb", "grid": "surface"}}])");
    const std::string points = bake.folder / "points.txt";
    std::ofstream(points) << "3 0 0\n1 0.25 0\n-5 0 0\n";
    const ProgramRun probed = run_anvil({"probe", recipe, points});
    INFO(probed.err);
    REQUIRE(probed.status == 0);
    std::istringstream text(probed.out);
    for (const double expected : {1.0, -0.75, 5.0}) {
        double distance = 0;
        double normal = 0;
        text >> distance >> normal >> normal >> normal;
        CHECK(distance == Approx(expected).margin(0.1 * 2.0 / 128)); // a tenth of a voxel
    }
}

TEST_CASE("bake says which occluder it wants, and what a level set cannot hold", "[app][bake]") {
    const Bake bake;
    const auto check = [&](const std::vector<std::string>& arguments, const std::string& word) {
        const ProgramRun run = bake.run(arguments);
        CHECK(run.status == 2);
        CHECK_THAT(run.err, Catch::Contains(word));
        CHECK_FALSE(std::filesystem::exists(bake.vdb));
    };
    check({"-o", bake.vdb}, "\"ball\", \"bite\"");
    check({"-o", bake.vdb, "--occluder", "bal"}, "\"ball\", \"bite\"");
    check({"-o", bake.folder / "out.obj", "--occluder", "ball"}, ".vdb");
    bake.write_recipe("recipe.json", R"([{"name": "floor", "shape": {"plane": {"normal": [0, 1, 0]}}}])");
    check({"-o", bake.vdb}, "floor");
    bake.write_recipe("recipe.json", "[]");
    check({"-o", bake.vdb}, "no occluder");
    bake.write_recipe("recipe.json", R"([{"name": "tool", "shape": {"vdb": "gone.vdb"}}])");
    check({"-o", bake.vdb}, "gone.vdb");
}

TEST_CASE("A level set from a file stops a surface as the sphere that it holds does", "[app][bake]") {
    const Bake bake;
    bake.write_recipe("recipe.json", R"([{"name": "ball", "shape": {"sphere": {"radius": 0.3}},
        "field": {"kind": "dense", "resolution": 32}}])");
    REQUIRE(bake.run({"-o", bake.vdb}).status == 0);
    const ForgeFolder forge;
    std::filesystem::copy_file(bake.vdb, forge.path("out.vdb"));
    forge.write(
        "push.json",
        recipe_text(
            R"([{"kind": "translate", "radius": 1,
        "handles": [{"at": {"nearest": [0, 0, 1]}, "by": [0, 0, -0.9]}]}])",
            R"([{"name": "tool", "shape": {"vdb": "out.vdb"}, "field": {"kind": "dense", "resolution": 32},
            "influence": {"kind": "hard"}}])"));
    const ProgramRun run = forge.forge({forge.path("push.json"), "--device", "cpu", "-o",
                                        forge.path("out.ply"), "--report", forge.path("report.json")});
    INFO(run.err);
    REQUIRE(run.status == 0);
    const auto edit = nlohmann::json::parse(content_of(forge.path("report.json")))["edits"][0];
    CHECK(edit["occluder"]["penetrating_vertices"] == 0);
    CHECK(edit["occluder"]["contact_vertices"].get<int>() > 10);
    size_t inside = 0;
    for (const Vec3& p : forge.mesh("out.ply").positions) {
        inside +=
            glm::length(p) < 0.3 - 0.1 * 0.6 / 32; // the level set's surface is off by a tenth of a voxel
    }
    CHECK(inside == 0);
}

TEST_CASE("A device bakes what the CPU bakes, to the bit; one that is not there is status 3", "[app][bake]") {
    const ForgeFolder forge;
    REQUIRE(run_anvil({"sample", "bust", "-o", forge.path("tool.ply"), "--vertices", "600"}).status == 0);
    forge.write("push.json", recipe_text(R"([{"kind": "translate", "radius": 1,
        "handles": [{"at": {"nearest": [0, 0, 1]}, "by": [0, 0, -0.9]}]}])",
                                         R"([{"name": "tool", "shape": {"mesh": "tool.ply"},
            "transform": {"translate": [0, -0.5, 0]},
            "field": {"kind": "adaptive", "resolution": 24}}])"));
    RunLimits limits;
    limits.environment = {"ANVIL_CACHE=off"};
    const auto run = [&](const std::vector<std::string>& arguments) {
        std::vector<std::string> all{"forge", forge.path("push.json"), "-o", forge.path("out.ply")};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return run_anvil(all, limits);
    };
    std::string on_cpu;
    for (const std::string where : {"cpu", "device"}) {
        const ProgramRun done = run({"--device", "0", "--bake", where});
        INFO(done.err);
        REQUIRE(done.status == 0);
        on_cpu = on_cpu.empty() ? content_of(forge.path("out.ply")) : on_cpu;
        const bool same = content_of(forge.path("out.ply")) == on_cpu;
        CHECK(same);
    }
    const ProgramRun nowhere = run({"--device", "cpu", "--bake", "device"});
    CHECK(nowhere.status == 2);
    CHECK_THAT(nowhere.err, Catch::Contains("--device"));
    CHECK(run_anvil({"bake", forge.path("push.json"), "-o", forge.path("a.vdb"), "--device", "no such"})
              .status == 3);
}

TEST_CASE("bake writes the same level set whatever the device", "[app][bake]") {
    const Bake bake;
    REQUIRE(run_anvil({"sample", "bust", "-o", bake.folder / "tool.ply", "--vertices", "600"}).status == 0);
    bake.write_recipe("recipe.json", R"([{"name": "tool", "shape": {"mesh": "tool.ply"},
        "transform": {"translate": [3, 0, 0], "rotate": {"axis": [1, 1, 0], "degrees": 30}, "scale": 2},
        "field": {"kind": "dense", "resolution": 24}}])");
    bake.write_recipe("again.json", R"([{"name": "again", "shape": {"vdb": "out.vdb"}}])");
    std::ofstream(bake.folder / "points.txt") << "3 0 0\n4 1 0.25\n2 -1 0.5\n";
    std::string on_cpu;
    for (const std::string device : {"cpu", "0"}) {
        const ProgramRun baked = bake.run({"-o", bake.vdb, "--device", device});
        INFO(baked.err);
        REQUIRE(baked.status == 0);
        const ProgramRun probed =
            run_anvil({"probe", bake.folder / "again.json", bake.folder / "points.txt"});
        REQUIRE(probed.status == 0);
        on_cpu = on_cpu.empty() ? probed.out : on_cpu;
        CHECK(probed.out == on_cpu);
    }
}

TEST_CASE("A field that forge has baked is kept in the cache folder, and changes nothing", "[app][bake]") {
    const ForgeFolder forge;
    forge.write("push.json",
                recipe_text(R"([{"kind": "translate", "radius": 1,
        "handles": [{"at": {"nearest": [0, 0, 1]}, "by": [0, 0, -0.9]}]}])",
                            R"([{"name": "tool", "shape": {"torus": {"major": 0.4, "minor": 0.2}},
            "field": {"kind": "adaptive", "resolution": 32}}])"));
    RunLimits limits;
    limits.environment = {"ANVIL_CACHE=" + forge.path("cache")};
    const auto run = [&](const std::string& output) {
        const ProgramRun done = run_anvil(
            {"forge", forge.path("push.json"), "--device", "cpu", "-o", forge.path(output)}, limits);
        INFO(done.err);
        REQUIRE(done.status == 0);
        return content_of(forge.path(output));
    };
    const std::string fresh = run("fresh.ply");
    CHECK(std::distance(std::filesystem::directory_iterator(forge.path("cache")),
                        std::filesystem::directory_iterator()) == 1);
    CHECK(run("again.ply") == fresh);
    for (const auto& entry : std::filesystem::directory_iterator(forge.path("cache"))) {
        std::ofstream(entry.path()) << "damaged";
    }
    CHECK(run("mended.ply") == fresh);
}

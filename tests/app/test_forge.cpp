#include "tests/app/forge_folder.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

using namespace anvil;

namespace {

nlohmann::json json_in(const ForgeFolder& folder, const std::string& name) {
    return nlohmann::json::parse(content_of(folder.path(name)));
}

} // namespace

TEST_CASE("forge writes mesh, picture and report with the stable keys, and says what it did",
          "[app][forge]") {
    const ForgeFolder folder;
    folder.write("recipe.json",
                 recipe_text(pull_edit(), R"([{"name": "lid", "shape": {"sphere": {"radius": 0.3}},
                                               "transform": {"translate": [0, 1.4, 0]}}])"));
    const ProgramRun run = folder.forge({"recipe.json", "--device", "0", "-o", "out.ply", "--image",
                                         "out.png", "--size", "80x60", "--report", "out.json"});
    INFO(run.err);
    REQUIRE(run.status == 0);
    CHECK_THAT(run.out, Catch::Contains("out.ply"));
    CHECK_THAT(content_of(folder.path("out.png")), Catch::StartsWith("\x89PNG"));
    CHECK(folder.mesh("out.ply").vertex_count() == 1002);

    const nlohmann::json report = json_in(folder, "out.json");
    for (const char* key : {"device", "driver", "vertices", "faces", "seconds", "edits", "warnings"}) {
        CHECK(report.contains(key));
    }
    for (const char* key :
         {"load", "distance", "solve", "refine", "bake", "upload", "deform", "download", "write"}) {
        INFO(key);
        CHECK(report["seconds"].contains(key));
    }
    REQUIRE(report["edits"].size() == 1);
    const nlohmann::json& edit = report["edits"][0];
    for (const char* key : {"kind", "moved", "rank", "condition", "amplification", "handles", "steps",
                            "samples", "occluder", "volume"}) {
        INFO(key);
        CHECK(edit.contains(key));
    }
    CHECK(edit["kind"] == "translate");
    CHECK(edit["rank"] == 1);
    CHECK(edit["handles"][0]["target_error"].get<double>() < 1e-6);
    CHECK(edit["occluder"]["penetrating_vertices"] == 0);
    CHECK(edit["volume"]["before"].get<double>() > 4);
}

TEST_CASE("Without -o the result lies beside the recipe, and the input mesh stays as it was",
          "[app][forge]") {
    const ForgeFolder folder;
    const std::string before = content_of(folder.path("mesh.ply"));
    folder.write("pull.json", recipe_text(pull_edit()));
    REQUIRE(folder.forge({"pull.json", "--device", "cpu"}).status == 0);
    CHECK(folder.has("pull.forged.ply"));
    const bool untouched = content_of(folder.path("mesh.ply")) == before;
    CHECK(untouched);
    const ProgramRun quiet = folder.forge({"pull.json", "--device", "cpu", "--quiet"});
    CHECK(quiet.status == 0);
    CHECK(quiet.out.empty());
    CHECK(quiet.err.empty());
}

TEST_CASE("Vertices outside the region are written bit for bit as read, in every format", "[app][forge]") {
    const ForgeFolder folder;
    folder.write("pull.json", recipe_text(pull_edit()));
    const Mesh input = folder.mesh("mesh.ply");
    for (const std::string extension : {"ply", "obj", "off"}) {
        INFO(extension);
        REQUIRE(folder.forge({"pull.json", "--device", "cpu", "-o", "out." + extension}).status == 0);
        const Mesh output = folder.mesh("out." + extension);
        REQUIRE(output.vertex_count() == input.vertex_count());
        size_t moved = 0;
        for (size_t v = 0; v < input.vertex_count(); ++v) {
            // Straight distance never exceeds the geodesic one: these are certainly outside.
            if (glm::length(input.positions[v] - Vec3(0, 1, 0)) > 0.8) {
                CHECK(output.positions[v] == input.positions[v]);
            }
            moved += output.positions[v] != input.positions[v] ? 1 : 0;
        }
        CHECK(moved > 50);
        CHECK(output.corners == input.corners);
    }
}

TEST_CASE("The same recipe gives the same bytes each time", "[app][forge]") {
    const ForgeFolder folder;
    folder.write("pull.json", recipe_text(pull_edit()));
    for (const std::string device : {"cpu", "0"}) {
        REQUIRE(folder.forge({"pull.json", "--device", device, "-o", "one.ply"}).status == 0);
        REQUIRE(folder.forge({"pull.json", "--device", device, "-o", "two.ply"}).status == 0);
        const bool same = content_of(folder.path("one.ply")) == content_of(folder.path("two.ply"));
        CHECK(same); // not the bytes: a failure would print them
    }
}

TEST_CASE("Options --mesh and --precision change what is read and how it is written", "[app][forge]") {
    const ForgeFolder folder;
    folder.write("pull.json", recipe_text(pull_edit()));
    REQUIRE(run_anvil({"sample", "torus", "-o", folder.path("torus.ply"), "--vertices", "600"}).status == 0);
    REQUIRE(folder.forge({"pull.json", "--device", "cpu", "--mesh", "torus.ply", "-o", "out.ply"}).status ==
            0);
    CHECK(folder.mesh("out.ply").vertex_count() == folder.mesh("torus.ply").vertex_count());
    const auto header_of = [&](const std::string& precision) {
        const std::string name = precision + ".ply";
        REQUIRE(folder.forge({"pull.json", "--device", "cpu", "--precision", precision, "-o", name}).status ==
                0);
        const std::string text = content_of(folder.path(name));
        return text.substr(0, text.find("end_header"));
    };
    CHECK_THAT(header_of("float"), Catch::Contains("property float x"));
    CHECK_THAT(header_of("double"), Catch::Contains("property double x"));
}

TEST_CASE("Without a Vulkan device forge says so, and --device cpu works", "[app][forge]") {
    const ForgeFolder folder;
    folder.write("pull.json", recipe_text(pull_edit()));
    const auto forge_without = [&](const std::string& device) {
        RunLimits limits;
        limits.environment = {"VK_ICD_FILENAMES=/nonexistent", "VK_DRIVER_FILES=/nonexistent"};
        limits.folder = std::filesystem::path(folder.path("pull.json")).parent_path();
        return run_anvil({"forge", "pull.json", "-o", "out.ply", "--device", device}, limits);
    };
    const ProgramRun named = forge_without("0");
    CHECK(named.status == 3);
    CHECK_THAT(named.err, Catch::StartsWith("anvil: error: ") && Catch::Contains("Vulkan") &&
                              Catch::Contains("--device cpu"));
    CHECK_FALSE(folder.has("out.ply"));
    const ProgramRun automatic = forge_without("auto"); // the CPU back end, and says why
    CHECK(automatic.status == 0);
    CHECK_THAT(automatic.err, Catch::StartsWith("anvil: warning: ") && Catch::Contains("Vulkan"));
    CHECK(forge_without("cpu").status == 0);
    CHECK(folder.has("out.ply"));
    CHECK(folder.forge({"pull.json", "-o", "out.ply", "--device", "no such device"}).status == 3);
}

TEST_CASE("An interrupt ends forging with status 130 and leaves no file behind", "[app][forge]") {
    const ForgeFolder folder;
    REQUIRE(run_anvil({"sample", "sphere", "-o", folder.path("mesh.ply"), "--vertices", "40000"}).status ==
            0);
    // Several fields to bake take long enough to be interrupted.
    std::string occluders;
    for (int i = 0; i < 4; ++i) {
        occluders += std::string(i > 0 ? "," : "[") + R"({"name": "o)" + std::to_string(i) +
                     R"(", "shape": {"torus": {"major": 0.5, "minor": 0.1}},
                        "field": {"kind": "dense", "resolution": 512}})";
    }
    folder.write("slow.json", recipe_text(pull_edit(), occluders + "]"));
    RunLimits limits;
    limits.interrupt_after = 0.3;
    limits.folder = std::filesystem::path(folder.path("slow.json")).parent_path();
    const ProgramRun run = run_anvil({"forge", "slow.json", "-o", "out.ply", "--device", "cpu"}, limits);
    CHECK(run.status == 130);
    CHECK_THAT(run.err, Catch::Contains("anvil: error: interrupted"));
    const auto files = std::distance(std::filesystem::directory_iterator(limits.folder),
                                     std::filesystem::directory_iterator());
    CHECK(files == 2); // the mesh and the recipe
}

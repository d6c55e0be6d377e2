#include "tests/app/forge_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

using namespace anvil;

namespace {

std::string refined_pull() {
    return R"([{"kind": "translate", "handles": [{"at": {"nearest": [0, 1, 0]}, "by": [0, 0.5, 0]}], "radius": 0.6,
               "shape": "linear", "refine": {"tolerance": 0.02}}])";
}

} // namespace

TEST_CASE("forge --parents and --delta say where new vertices come from and what the file's own do",
          "[app][forge]") {
    const ForgeFolder folder;
    folder.write("recipe.json", recipe_text(refined_pull()));
    const ProgramRun run =
        folder.forge({"recipe.json", "--device", "cpu", "-o", "out.obj", "--parents", "parents.txt",
                      "--delta", "delta.obj", "--report", "report.json", "--precision", "double"});
    INFO(run.err);
    REQUIRE(run.status == 0);
    const Mesh before = folder.mesh("mesh.ply");
    const Mesh out = folder.mesh("out.obj");
    const Mesh delta = folder.mesh("delta.obj");
    REQUIRE(out.vertex_count() > before.vertex_count());
    REQUIRE(delta.vertex_count() == before.vertex_count());
    CHECK(delta.corners == before.corners);
    for (size_t v = 0; v < before.vertex_count(); ++v) {
        CHECK(glm::distance(delta.positions[v], out.positions[v]) < 1e-6);
    }
    std::istringstream lines(content_of(folder.path("parents.txt")));
    size_t count = 0;
    size_t a = 0;
    size_t b = 0;
    double place = 0;
    while (lines >> a >> b >> place) {
        CHECK(std::max(a, b) < before.vertex_count() + count);
        CHECK((place > 0 && place < 1));
        ++count;
    }
    CHECK(count == out.vertex_count() - before.vertex_count());
    const auto report = nlohmann::json::parse(content_of(folder.path("report.json")));
    CHECK(report["edits"][0]["refine"]["added"] == count);
    CHECK(report["edits"][0]["refine"]["stopped_by"] == "tolerance");
    CHECK(report["vertices"] == out.vertex_count());

    REQUIRE(
        folder.forge({"recipe.json", "--device", "cpu", "-o", "again.obj", "--delta", "delta.txt"}).status ==
        0);
    std::istringstream moves(content_of(folder.path("delta.txt")));
    for (size_t v = 0; v < before.vertex_count(); ++v) {
        Vec3 d;
        REQUIRE((moves >> d.x >> d.y >> d.z));
        CHECK(glm::distance(before.positions[v] + d, out.positions[v]) < 1e-6);
    }
}

TEST_CASE("forge --dry-run writes no mesh and says what refinement would add", "[app][forge]") {
    const ForgeFolder folder;
    folder.write("recipe.json", recipe_text(refined_pull()));
    const ProgramRun run = folder.forge({"recipe.json", "--device", "cpu", "-o", "out.ply", "--dry-run"});
    REQUIRE(run.status == 0);
    CHECK_THAT(run.out, Catch::Contains("edits[0]") && Catch::Contains("would be added"));
    CHECK(!folder.has("out.ply"));
    const ProgramRun same =
        folder.forge({"recipe.json", "--device", "cpu", "-o", "out.ply", "--delta", "out.ply"});
    CHECK(same.status == 2);
    CHECK_THAT(same.err, Catch::Contains("same file"));
}

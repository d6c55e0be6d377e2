#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

using namespace anvil;
namespace fs = std::filesystem;

namespace {

nlohmann::json facts_of(const std::string& mesh) {
    const ProgramRun run = run_anvil({"info", mesh, "--json"});
    REQUIRE(run.status == 0);
    return nlohmann::json::parse(run.out);
}

} // namespace

TEST_CASE("Every sample has the asked count within 10 %, is manifold, and all but the plane are closed",
          "[app][sample]") {
    const ScratchFolder folder;
    for (const std::string shape :
         {"sphere", "icosphere", "plane", "cylinder", "torus", "cube", "hand", "bust"}) {
        INFO(shape);
        const std::string file = folder / (shape + ".ply");
        const ProgramRun run = run_anvil({"sample", shape, "-o", file, "--vertices", "3000"});
        REQUIRE(run.status == 0);
        CHECK(run.err.empty());
        const nlohmann::json facts = facts_of(file);
        CHECK(facts["vertices"].get<double>() == Approx(3000).epsilon(0.1));
        CHECK(facts["non_manifold_edges"]["count"] == 0);
        CHECK(facts["bowtie_vertices"]["count"] == 0);
        CHECK(facts["closed"] == (shape != "plane"));
        CHECK(facts["warnings"].empty());
    }
}

TEST_CASE("A sample is written in the format of the extension", "[app][sample]") {
    const ScratchFolder folder;
    for (const std::string extension : {"obj", "ply", "stl", "off"}) {
        INFO(extension);
        const std::string file = folder / ("torus." + extension);
        REQUIRE(run_anvil({"sample", "torus", "-o", file, "--vertices", "500"}).status == 0);
        CHECK(facts_of(file)["euler_number"] == 0);
    }
}

TEST_CASE("A sample that cannot be made leaves the output file as it was", "[app][sample]") {
    const ScratchFolder folder;
    const std::string file = folder / "mesh.ply";
    std::ofstream(file) << "precious";
    const auto status_of = [&](const std::vector<std::string>& arguments) {
        const ProgramRun run = run_anvil(arguments);
        CHECK_THAT(run.err, Catch::StartsWith("anvil: error: "));
        CHECK(content_of(file) == "precious");
        return run.status;
    };
    CHECK(status_of({"sample", "cow", "-o", file}) == 2);
    CHECK(status_of({"sample", "hand", "-o", file, "--vertices", "3"}) == 2);
    CHECK(status_of({"sample", "hand", "-o", file, "--vertices", "many"}) == 2);
    CHECK(status_of({"sample", "hand", "-o", file, "--vertices", "-5"}) == 2);
    CHECK(status_of({"sample", "hand", "-o", file, "--vertices", "99999999999999"}) == 2);
    CHECK(status_of({"sample", "cube", "-o", folder / "mesh.xyz"}) == 2);
    CHECK(status_of({"sample", "cube", "-o", folder / "nowhere" / "mesh.ply"}) == 4);
    CHECK(status_of({"sample", "cube"}) == 2);
    CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 1);
}

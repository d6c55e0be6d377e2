#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

using namespace anvil;
namespace fs = std::filesystem;

namespace {

const fs::path malformed = fs::path(ANVIL_TEST_DATA) / "malformed";

// Damaged beyond use; everything else but ok* is odd and loads with a warning.
const std::set<std::string> damaged = {
    "all_degenerate.obj",
    "empty.off",
    "empty.ply",
    "empty.stl",
    "garbage.obj",
    "huge_list_count.ply",
    "huge_vertex_count.ply",
    "huge_vertex_count_ascii.ply",
    "index_out_of_range.obj",
    "index_out_of_range.ply",
    "index_overflow.obj",
    "inf.obj",
    "nan.obj",
    "nan_binary.ply",
    "negative_index_too_far.obj",
    "negative_list_count.ply",
    "no_end_header.ply",
    "png_named.obj",
    "short_vertex_line.obj",
    "stl_ascii_truncated.stl",
    "stl_binary_count_4e9.stl",
    "stl_binary_count_too_big.stl",
    "trunc.off",
    "trunc_binary.ply",
};

// Two gigabytes of address space stop what believes a header's four thousand million; thread stacks and
// libraries fit in.
RunLimits hostile_limits() {
    RunLimits limits;
    limits.seconds = 20;
    limits.address_space = size_t{2} << 30;
    return limits;
}

void check_cost(const ProgramRun& run) {
    if (!under_sanitizers) {
        CHECK(run.seconds < 2);
        CHECK(run.peak_kilobytes < 200 * 1024);
    }
}

} // namespace

TEST_CASE("Every malformed file is an error, a warning or clean, within 2 seconds and 200 MB",
          "[app][info]") {
    size_t count = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(malformed)) {
        if (!entry.is_regular_file()) {
            continue;
        }
        const std::string path = entry.path();
        const std::string name = entry.path().filename();
        INFO(path);
        const ProgramRun run = run_anvil({"info", path}, hostile_limits());
        check_cost(run);
        ++count;
        if (damaged.contains(name)) {
            CHECK(run.status == 2);
            CHECK(run.out.empty());
            CHECK_THAT(run.err, Catch::StartsWith("anvil: error: " + path));
            CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
            continue;
        }
        CHECK(run.status == 0);
        CHECK_FALSE(run.out.empty());
        CHECK(all_lines_begin_with(run.err, "anvil: warning: "));
        CHECK(run.err.empty() == (path.find("malformed/ok") != std::string::npos));
    }
    CHECK(count == 45);
}

TEST_CASE("What is no readable mesh file is status 2 and named", "[app][info]") {
    const ScratchFolder folder;
    fs::create_directory(folder / "folder.obj");
    std::ofstream(folder / "mesh.xyz") << "0 0 0\n";
    std::ofstream(folder / "secret.obj") << "v 0 0 0\n";
    std::vector<std::string> names = {"missing.obj", "folder.obj", "mesh.xyz", "no_extension"};
    fs::permissions(folder / "secret.obj", fs::perms::none);
    if (!std::ifstream(folder / "secret.obj")) { // root may read everything
        names.emplace_back("secret.obj");
    }
    for (const std::string& name : names) {
        INFO(name);
        const ProgramRun run = run_anvil({"info", folder / name}, hostile_limits());
        CHECK(run.status == 2);
        CHECK(run.out.empty());
        CHECK_THAT(run.err, Catch::StartsWith("anvil: error: ") && Catch::Contains(name));
    }
}

TEST_CASE("info --json has the stable keys and the facts of the cube", "[app][info]") {
    const ProgramRun run = run_anvil({"info", malformed / "ok_crlf.obj", "--json"});
    REQUIRE(run.status == 0);
    const auto facts = nlohmann::json::parse(run.out);
    for (const char* key : {"file",
                            "vertices",
                            "faces",
                            "triangles",
                            "edges",
                            "components",
                            "closed",
                            "boundary_edges",
                            "boundary_loops",
                            "euler_number",
                            "low",
                            "high",
                            "diagonal",
                            "area",
                            "volume",
                            "min_angle",
                            "needles",
                            "non_manifold_edges",
                            "bowtie_vertices",
                            "inconsistent_edges",
                            "isolated_vertices",
                            "duplicate_positions",
                            "degenerate_triangles",
                            "nonplanar_faces",
                            "folded_faces",
                            "double_precision",
                            "vertex_attributes",
                            "face_attributes",
                            "corner_attributes",
                            "groups",
                            "warnings"}) {
        INFO(key);
        CHECK(facts.contains(key));
    }
    CHECK(facts["vertices"] == 8);
    CHECK(facts["faces"] == 12);
    CHECK(facts["closed"] == true);
    CHECK(facts["euler_number"] == 2);
    CHECK(facts["volume"].get<double>() == Approx(1).epsilon(1e-15));
    CHECK(facts["isolated_vertices"]["count"] == 0);
    CHECK(facts["isolated_vertices"]["first"].is_null());
    CHECK(facts["warnings"].empty());
}

TEST_CASE("info --json repeats the warnings and names the first place", "[app][info]") {
    const ProgramRun run = run_anvil({"info", malformed / "isolated_vertices.obj", "--json"});
    REQUIRE(run.status == 0);
    const auto facts = nlohmann::json::parse(run.out);
    CHECK(facts["isolated_vertices"]["count"] == 2);
    REQUIRE(facts["warnings"].size() == 1);
    CHECK(run.err == "anvil: warning: " + facts["warnings"][0].get<std::string>() + "\n");
}

TEST_CASE("Numbers are read and written the same in every locale", "[app][info]") {
    const std::string mesh = malformed / "ok_crlf.obj";
    RunLimits german;
    german.environment = {"LC_ALL=de_DE.UTF-8", "LANG=de_DE.UTF-8"};
    CHECK(run_anvil({"info", mesh}).out == run_anvil({"info", mesh}, german).out);
}

#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

using namespace anvil;
using Json = nlohmann::json;

namespace {

const std::string chosen = "blend/k1/"; // quick even under sanitizers

std::set<std::string> keys_of(const Json& object) {
    std::set<std::string> keys;
    for (const auto& [key, value] : object.items()) {
        keys.insert(key);
    }
    return keys;
}

Json measured(const std::string& path, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"bench", "--quick", "--only", chosen, "--json", path};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_anvil(arguments);
    INFO(run.err);
    REQUIRE(run.status == 0);
    CHECK_THAT(run.out, Catch::Contains(chosen) && Catch::Contains("median ms"));
    return Json::parse(content_of(path));
}

void write_json(const std::string& path, const Json& json) {
    std::ofstream(path) << json.dump();
}

} // namespace

TEST_CASE("bench --json has the stable keys and numbers that can be", "[app][bench]") {
    const ScratchFolder folder;
    const Json json = measured(folder / "now.json");
    CHECK(keys_of(json) == std::set<std::string>{"machine", "quick", "clock", "cases"});
    for (const char* key : {"cpu", "cores", "memory_bytes", "device", "driver", "anvil"}) {
        INFO(key);
        CHECK(json["machine"].contains(key));
    }
    REQUIRE(json["cases"].size() == 1);
    const Json& bench = json["cases"][0];
    CHECK(keys_of(bench) == std::set<std::string>{"name", "vertices", "region", "samples", "median_s",
                                                  "min_s", "max_s", "bytes", "device_bytes", "ratio"});
    CHECK_THAT(bench["name"].get<std::string>(), Catch::StartsWith(chosen));
    CHECK(bench["region"] == bench["vertices"]);
    CHECK(bench["samples"].get<int>() >= 3);
    CHECK(bench["min_s"].get<double>() > 0);
    CHECK(bench["min_s"] <= bench["median_s"]);
    CHECK(bench["median_s"] <= bench["max_s"]);
    // One handle: a distance in, a displacement out; nothing is counted without occluders.
    CHECK(bench["bytes"].get<size_t>() == bench["vertices"].get<size_t>() * (4 + 12));
    CHECK(keys_of(bench["ratio"]) == std::set<std::string>{"cpu", "cpu_float", "memcpy"});
    for (const auto& [yardstick, ratio] : bench["ratio"].items()) {
        INFO(yardstick);
        CHECK(ratio.get<double>() > 0);
    }
}

TEST_CASE("bench --compare tells a slower case from a slower machine", "[app][bench]") {
    const ScratchFolder folder;
    const std::string now = folder / "now.json";
    const std::string before = folder / "before.json";
    // A thousandth and a thousandfold: no noise of the machine comes near.
    Json earlier = measured(now, {"--device", "cpu"});
    const auto compared = [&] {
        write_json(before, earlier);
        return run_anvil({"bench", "--quick", "--only", chosen, "--device", "cpu", "--compare", before});
    };
    Json& bench = earlier["cases"][0];
    for (auto& [yardstick, ratio] : bench["ratio"].items()) {
        ratio = ratio.get<double>() / 1000;
    }
    const ProgramRun slower = compared();
    CHECK(slower.status == 0);
    CHECK_THAT(slower.out, Catch::Contains("SLOWER:\n  " + chosen));
    CHECK_THAT(slower.out, Catch::Contains("1 of 1 cases are slower by more than 15 %"));

    for (auto& [yardstick, ratio] : bench["ratio"].items()) {
        ratio = ratio.get<double>() * 1e6;
    }
    const ProgramRun faster = compared();
    CHECK(faster.status == 0);
    CHECK_THAT(faster.out, Catch::Contains("faster:\n  " + chosen));
    CHECK_THAT(faster.out, Catch::Contains("0 of 1 cases are slower"));

    // Slower in seconds only, and against one yardstick only, is the machine's doing.
    earlier = Json::parse(content_of(now));
    earlier["cases"][0]["median_s"] = earlier["cases"][0]["median_s"].get<double>() / 1000;
    earlier["cases"][0]["ratio"]["memcpy"] = earlier["cases"][0]["ratio"]["memcpy"].get<double>() / 1000;
    CHECK_THAT(compared().out, Catch::Contains("by the yardstick cpu"));
}

TEST_CASE("bench refuses what it cannot do before it measures", "[app][bench]") {
    const ScratchFolder folder;
    const std::string broken = folder / "broken.json";
    std::ofstream(broken)
        << R"({"machine": {"cpu": "a", "device": "b"}, "clock": "wall", "cases": [{"name": "c"}]})";
    const std::vector<std::pair<std::vector<std::string>, std::string>> faults{
        {{"--only", "no-such-case"}, "blend/k1"},
        {{"--compare", folder / "missing.json"}, "missing.json"},
        {{"--compare", broken}, "cases[0]"},
        {{"--quicker"}, "--quicker"},
        {{"more"}, "more"}};
    for (const auto& [arguments, named] : faults) {
        INFO(named);
        std::vector<std::string> all{"bench", "--quick", "--device", "cpu"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const ProgramRun run = run_anvil(all);
        CHECK(run.status == 2);
        CHECK(run.out.empty());
        CHECK_THAT(run.err, Catch::StartsWith("anvil: error: ") && Catch::Contains(named));
    }
    CHECK(run_anvil({"bench", "--quick", "--only", chosen, "--device", "no such device"}).status == 3);
}

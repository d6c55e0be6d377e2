#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

using namespace anvil;

namespace {

struct Probe {
    ScratchFolder folder;
    std::string recipe = folder / "recipe.json";
    std::string points = folder / "points.txt";

    Probe(const std::string& occluders, const std::string& points_text) {
        std::ofstream(recipe) << R"({"anvil": 1, "mesh": "none.ply", "edits": [], "occluders": )" << occluders
                              << "}";
        std::ofstream(points) << points_text;
    }
    ProgramRun run() const { return run_anvil({"probe", recipe, points}); }
    std::vector<double> numbers() const {
        const ProgramRun done = run();
        INFO(done.err);
        REQUIRE(done.status == 0);
        std::istringstream text(done.out);
        std::vector<double> result;
        for (double x = 0; text >> x;) {
            result.push_back(x);
        }
        return result;
    }
};

// Distances of a few units: a handful of roundings.
void check_close(const std::vector<double>& found, const std::vector<double>& expected) {
    REQUIRE(found.size() == expected.size());
    for (size_t i = 0; i < found.size(); ++i) {
        INFO("number " << i);
        CHECK(found[i] == Approx(expected[i]).margin(1e-14));
    }
}

} // namespace

TEST_CASE("probe gives signed distance and outward normal of a sphere in its pose", "[app][probe]") {
    const Probe probe(R"([{"name": "ball", "shape": {"sphere": {"radius": 0.5}},
        "transform": {"translate": [1, 0, 0], "scale": 2}}])",
                      "4 0 0\n1 0.25 0\r\n\n  1\t-3 0\n");
    check_close(probe.numbers(), {2, 1, 0, 0, -0.75, 0, 1, 0, 2, 0, -1, 0});
}

TEST_CASE("probe answers for the nearest of several occluders", "[app][probe]") {
    const Probe probe(R"([{"name": "floor", "shape": {"plane": {"normal": [0, 2, 0], "offset": -1}}},
                          {"name": "box", "shape": {"box": {"half": [1, 1, 1]}},
                           "transform": {"translate": [5, 5, 0]}}])",
                      "0 0.5 0\n5 7 0\n0 -3 0\n");
    check_close(probe.numbers(), {1.5, 0, 1, 0, 1, 0, 1, 0, -2, 0, 1, 0});
}

TEST_CASE("Points that are none, and recipes without occluders, are status 2 with file and line",
          "[app][probe]") {
    const std::string ball = R"([{"name": "ball", "shape": {"sphere": {"radius": 1}}}])";
    for (const std::string bad : {"1 2", "1 2 3 4", "1 2 x", "1 2 nan", "1,2,3", "1 2 inf"}) {
        INFO(bad);
        const ProgramRun run = Probe(ball, "0 0 0\n" + bad + "\n").run();
        CHECK(run.status == 2);
        CHECK(run.out.empty());
        CHECK_THAT(run.err, Catch::Contains("points.txt, line 2") && Catch::Contains(bad));
    }
    CHECK(Probe("[]", "0 0 0\n").run().status == 2);
    Probe missing(ball, "");
    CHECK(run_anvil({"probe", missing.recipe, missing.folder / "no.txt"}).status == 2);
    CHECK(run_anvil({"probe", missing.folder / "no.json", missing.points}).status == 2);
    CHECK(missing.run().status == 0);
}

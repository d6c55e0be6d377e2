#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

using namespace anvil;

namespace {

std::vector<double> numbers_in(const std::string& text) {
    std::vector<double> numbers;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        numbers.push_back(std::stod(line)); // reads "inf" too
    }
    return numbers;
}

// A flat strip of unit squares cut in two: distances are exact by hand, and one part is out of reach.
//   3 4 5     9 ...
//   0 1 2     6 7 (8: the far triangle)
const char* const strip_text = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n"
                               "v 9 0 0\nv 9 1 0\nv 8 0 0\n"
                               "f 1 2 5 4\nf 2 3 6 5\nf 7 8 9\n";

struct Strip {
    ScratchFolder folder;
    std::string mesh = folder / "strip.obj";

    Strip() { std::ofstream(mesh) << strip_text; }

    ProgramRun run(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"distance", mesh});
        return run_anvil(arguments);
    }
    std::vector<double> distances(const std::vector<std::string>& arguments) const {
        const ProgramRun done = run(arguments);
        INFO(done.err);
        REQUIRE(done.status == 0);
        return numbers_in(done.out);
    }
};

// The approximate method carries its fronts in single precision: a handful of its roundings (6e-8 each).
void check_close(const std::vector<double>& found, const std::vector<double>& expected) {
    REQUIRE(found.size() == expected.size());
    for (size_t i = 0; i < found.size(); ++i) {
        INFO("vertex " << i);
        if (std::isinf(expected[i])) {
            CHECK(std::isinf(found[i]));
        } else {
            CHECK(found[i] == Approx(expected[i]).margin(1e-6).epsilon(1e-6));
        }
    }
}

const double inf = INFINITY;

} // namespace

TEST_CASE("distance gives one number per vertex, exact on a flat strip, inf where not reached",
          "[app][distance]") {
    const Strip strip;
    check_close(strip.distances({"--from", "v:0"}),
                {0, 1, 2, 1, std::sqrt(2.0), std::sqrt(5.0), inf, inf, inf});
    const ProgramRun run = strip.run({"--from", "v:0"});
    CHECK_THAT(run.out, Catch::EndsWith("\ninf\ninf\ninf\n"));
    CHECK(run.out == strip.run({"--from", "v:0", "--method", "auto"}).out);
}

TEST_CASE("distance takes vertices, points inside faces and nearest points, and the nearest of several",
          "[app][distance]") {
    const Strip strip;
    const std::vector<double> from_centre = {std::sqrt(0.5),
                                             std::sqrt(0.5),
                                             std::sqrt(2.5),
                                             std::sqrt(0.5),
                                             std::sqrt(0.5),
                                             std::sqrt(2.5),
                                             inf,
                                             inf,
                                             inf};
    check_close(strip.distances({"--from", "0.5,0.5,7"}), from_centre);
    check_close(strip.distances({"--from", "f:2:0.25,0.25,0.5", "--metric", "euclidean"}),
                {std::hypot(8.5, 0.25), std::hypot(7.5, 0.25), std::hypot(6.5, 0.25), std::hypot(8.5, 0.75),
                 std::hypot(7.5, 0.75), std::hypot(6.5, 0.75), std::hypot(0.5, 0.25), std::hypot(0.5, 0.75),
                 std::hypot(0.5, 0.25)});
    check_close(strip.distances({"--from", "v:0", "--from", "v:6"}),
                {0, 1, 2, 1, std::sqrt(2.0), std::sqrt(5.0), 0, 1, 1});
    // A point below zero begins with a minus and is still a point.
    check_close(strip.distances({"--from", "-1,-1,0"}), strip.distances({"--from", "v:0"}));
}

TEST_CASE("A radius turns what lies beyond into inf and changes no other digit", "[app][distance]") {
    const ScratchFolder folder;
    const std::string mesh = folder / "bumpy.ply";
    REQUIRE(run_anvil({"sample", "hand", "-o", mesh, "--vertices", "2000"}).status == 0);
    for (const std::string method : {"auto", "approximate"}) {
        INFO(method);
        const auto all = numbers_in(run_anvil({"distance", mesh, "--from", "v:17", "--method", method}).out);
        const auto near = numbers_in(
            run_anvil({"distance", mesh, "--from", "v:17", "--radius", "0.3", "--method", method}).out);
        REQUIRE(all.size() == near.size());
        REQUIRE(std::count_if(near.begin(), near.end(), [](double d) { return std::isfinite(d); }) > 20);
        for (size_t v = 0; v < all.size(); ++v) {
            CHECK(near[v] == (all[v] <= 0.3 ? all[v] : inf));
        }
    }
}

TEST_CASE("distance writes a file whole in place of standard output", "[app][distance]") {
    const Strip strip;
    const std::string out = strip.folder / "out.txt";
    const ProgramRun run = strip.run({"--from", "v:0", "-o", out});
    CHECK(run.status == 0);
    CHECK(run.out.empty());
    CHECK(content_of(out) == strip.run({"--from", "v:0"}).out);
    CHECK(strip.run({"--from", "v:0", "-o", strip.folder / "no" / "out.txt"}).status == 4);
}

TEST_CASE("A source or radius that cannot be meant is status 2 and shown", "[app][distance]") {
    const Strip strip;
    const std::string out = strip.folder / "out.txt";
    std::ofstream(out) << "precious";
    const auto check = [&](const std::vector<std::string>& arguments, const std::string& shown) {
        INFO(shown);
        std::vector<std::string> all = arguments;
        all.insert(all.end(), {"-o", out});
        const ProgramRun run = strip.run(all);
        CHECK(run.status == 2);
        CHECK_THAT(run.err, Catch::StartsWith("anvil: error: ") && Catch::Contains(shown));
        CHECK(content_of(out) == "precious");
    };
    check({}, "--from");
    check({"--from", "v:9"}, "9 vertices");
    check({"--from", "v:-1"}, "v:-1");
    check({"--from", "f:3:1,0,0"}, "face 3");
    check({"--from", "f:0.2:1,0,0"}, "triangle 2");
    check({"--from", "f:0:0.5,0.6,0.2"}, "barycentrics");
    check({"--from", "1,2"}, "1,2");
    check({"--from", "1,2,nan"}, "1,2,nan");
    check({"--from", "v:0", "--radius", "0"}, "--radius");
    check({"--from", "v:0", "--radius", "-1"}, "--radius: found -1;");
    check({"--from", "v:0", "--radius", "nan"}, "--radius");
    check({"--from", "v:0", "--radius", "wide"}, "--radius");
    check({"--from", "v:0", "--metric", "taxi"}, "--metric");
    check({"--from", "v:0", "--method", "magic"}, "--method");
    check({"--from", "v:0", "--image", "p.png", "--size", "0x7"}, "0x7");
    check({"--from", "v:0", "--image", "p.png", "--view", "inside"}, "inside");
}

TEST_CASE("distance draws a picture", "[app][distance]") {
    const Strip strip;
    const std::string picture = strip.folder / "picture.png";
    const ProgramRun run = strip.run({"--from", "v:0", "--image", picture, "--size", "64x48"});
    INFO(run.err);
    CHECK(run.status == 0);
    CHECK_THAT(content_of(picture), Catch::StartsWith("\x89PNG"));
    // The strip is sqrt(5) long: the lines' distance is round. `auto` says what it took.
    CHECK(run.out == "isolines every 0.1, farthest 2.23607 (exact) -> " + picture + "\n");
    const auto last_line = [&](const std::string& option, const std::string& value) {
        return strip.run({"--from", "v:0", "--image", picture, "--size", "64x48", option, value}).out;
    };
    CHECK_THAT(last_line("--method", "approximate"), Catch::Contains(" (approximate) -> "));
    CHECK_THAT(last_line("--metric", "euclidean"), Catch::Contains("farthest 9.05539 -> "));
    const std::string lone = strip.folder / "lone.obj";
    std::ofstream(lone) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nf 1 2 3\n";
    const ProgramRun nothing =
        run_anvil({"distance", lone, "--from", "v:3", "--image", picture, "--size", "64x48"});
    CHECK(nothing.status == 0);
    CHECK(nothing.out == "farthest 0 (exact) -> " + picture + "\n");
}

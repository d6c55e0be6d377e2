#include "tests/app/program.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <sys/wait.h>

using namespace anvil;

namespace {

const std::vector<std::string> commands = {"forge",   "info",     "distance", "probe", "sample",
                                           "devices", "selftest", "bench",    "view"};

} // namespace

TEST_CASE("What the program does not understand is status 2, one line of error, and no output", "[app]") {
    const std::vector<std::vector<std::string>> wrong = {
        {}, {"foo"}, {"--foo"}, {"info"}, {"info", "--jsn", "mesh.obj"}, {"info", "one.obj", "two.obj"},
    };
    for (const auto& arguments : wrong) {
        const ProgramRun run = run_anvil(arguments);
        INFO("arguments: " << Catch::StringMaker<std::vector<std::string>>::convert(arguments));
        CHECK(run.status == 2);
        CHECK(run.out.empty());
        CHECK_THAT(run.err, Catch::StartsWith("anvil: error: "));
        CHECK_THAT(run.err, Catch::Contains("--help"));
        CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    }
    CHECK_THAT(run_anvil({"foo"}).err, Catch::Contains("foo"));
    CHECK_THAT(run_anvil({"info", "--jsn", "mesh.obj"}).err, Catch::Contains("--jsn"));
}

TEST_CASE("Every command has help with an example, and the version", "[app]") {
    const std::string overview = run_anvil({"--help"}).out;
    CHECK_THAT(overview, Catch::Contains("Example:"));
    CHECK(run_anvil({"--version"}).out == "anvil " ANVIL_VERSION "\n");
    for (const std::string& command : commands) {
        INFO(command);
        const ProgramRun help = run_anvil({command, "--help"});
        CHECK(help.status == 0);
        CHECK(help.err.empty());
        CHECK_THAT(help.out, Catch::Contains("Example:\n  anvil " + command));
        CHECK_THAT(overview, Catch::Contains("\n  " + command + " "));
        const ProgramRun version = run_anvil({command, "--version"});
        CHECK(version.status == 0);
        CHECK(version.out == "anvil " ANVIL_VERSION "\n");
    }
}

TEST_CASE("A full disk behind standard output is status 4", "[app]") {
    // The shell stands between, since the tests' own runner always gives a file.
    const std::string mesh = std::string(ANVIL_TEST_DATA) + "/malformed/ok_crlf.obj";
    const int state =
        std::system(("'" ANVIL_PROGRAM "' info '" + mesh + "' > /dev/full 2> /dev/null").c_str());
    REQUIRE(WIFEXITED(state));
    CHECK(WEXITSTATUS(state) == 4);
}

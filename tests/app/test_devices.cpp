#include "tests/app/program.h"

#include <catch2/catch.hpp>

using namespace anvil;

TEST_CASE("devices lists every Vulkan device, the one that auto takes, and the CPU", "[app][devices]") {
    const ProgramRun run = run_anvil({"devices"});
    CHECK(run.status == 0);
    CHECK(run.err.empty());
    CHECK_THAT(run.out, Catch::Contains("<- auto") && Catch::Contains("\ncpu  "));
}

TEST_CASE("Without a Vulkan driver devices says so and lists the CPU", "[app][devices]") {
    RunLimits limits;
    limits.environment = {"VK_ICD_FILENAMES=/nonexistent", "VK_DRIVER_FILES=/nonexistent"};
    const ProgramRun run = run_anvil({"devices"}, limits);
    CHECK(run.status == 0);
    CHECK_THAT(run.err, Catch::StartsWith("anvil: warning: ") && Catch::Contains("Vulkan"));
    CHECK_THAT(run.out, Catch::StartsWith("cpu  "));
    CHECK(run_anvil({"selftest"}, limits).status == 3);
}

TEST_CASE("selftest holds the CPU against itself to zero", "[app][selftest]") {
    const ProgramRun run = run_anvil({"selftest", "--device", "cpu"});
    INFO(run.out);
    CHECK(run.status == 0);
    CHECK_THAT(run.out, !Catch::Contains("BAD"));
}

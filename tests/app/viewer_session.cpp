#include "tests/app/viewer_session.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>

namespace anvil {

ViewerSession::ViewerSession() {
    REQUIRE(run_anvil({"sample", "hand", "-o", mesh(), "--vertices", "4000"}).status == 0);
}

ProgramRun ViewerSession::play(const std::string& script, const std::string& device,
                               const std::string& opens) const {
    const std::string path = folder_ / "script.txt";
    std::ofstream(path) << script;
    RunLimits limits;
    limits.environment = {"ANVIL_STATE=" + file("state")};
    limits.seconds = 300;
    REQUIRE(std::getenv("DISPLAY") != nullptr); // tests/run gives one; by hand: xvfb-run -a
    return run_anvil({"view", opens.empty() ? mesh() : opens, "--script", path, "--device", device}, limits);
}

} // namespace anvil

#include "tests/app/viewer_session.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace anvil {

namespace {

std::string repeated(const std::string& line, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) {
        text += line;
    }
    return text;
}

} // namespace

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

void ViewerSession::check_history(const std::string& script, const std::string& mesh, int edits,
                                  const std::string& device) const {
    const std::string count = "expect edits " + std::to_string(edits) + "\n";
    const ProgramRun run = play(script + count + "save " + file("end.ply") + "\nsave " + file("end.json") +
                                    "\nwait\nexpect unsaved no\n" + repeated("key ctrl+z\nwait\n", edits) +
                                    "expect edits 0\nsave " + file("begin.ply") + "\nwait\n" +
                                    repeated("key ctrl+shift+z\nwait\n", edits) + count + "save " +
                                    file("again.ply") + "\nwait\nscreenshot " + file("end.png") + "\n",
                                device, mesh);
    INFO(run.err);
    CHECK(run.err.empty());
    REQUIRE(run.status == 0);
    const std::string end = content_of(file("end.ply"));
    CHECK(content_of(file("again.ply")) == end);
    CHECK(content_of(file("begin.ply")) != end);
    REQUIRE(run_anvil({"forge", file("end.json"), "-o", file("forged.ply"), "--device", device}).status == 0);
    CHECK(content_of(file("forged.ply")) == end);
    CHECK(std::filesystem::file_size(file("end.png")) > 20000);
}

} // namespace anvil

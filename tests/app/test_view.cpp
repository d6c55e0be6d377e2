#include "tests/app/viewer_session.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace anvil;
namespace fs = std::filesystem;

namespace {

/// Places of a hand's sample: the tip of a finger.
const std::string setup = "window 900 600\nwait\nview front\nframe\nradius 0.3\n";
const std::string bend = "move @0.0,10,0\nwait\ndrag 30 40\nwait\n";

} // namespace

TEST_CASE("A finger is bent, all is undone and redone, and the recipe forges the same mesh bit for bit",
          "[app][view]") {
    for (const std::string device : {"cpu", "0"}) {
        INFO(device);
        const ViewerSession session;
        const std::string script =
            setup + bend + "expect edits 1\nsave " + session.file("bent.ply") + "\nsave " +
            session.file("bent.json") + "\nwait\nexpect unsaved no\nkey ctrl+z\nwait\nexpect edits 0\nsave " +
            session.file("before.ply") + "\nkey ctrl+shift+z\nwait\nexpect edits 1\nsave " +
            session.file("again.ply") + "\nwait\nscreenshot " + session.file("bent.png");
        const ProgramRun run = session.play(script, device);
        CHECK(run.err.empty());
        REQUIRE(run.status == 0);
        CHECK(content_of(session.file("again.ply")) == content_of(session.file("bent.ply")));
        CHECK(content_of(session.file("before.ply")) != content_of(session.file("bent.ply")));
        REQUIRE(run_anvil({"forge", session.file("bent.json"), "-o", session.file("forged.ply"), "--device",
                           device})
                    .status == 0);
        CHECK(content_of(session.file("forged.ply")) == content_of(session.file("bent.ply")));
        CHECK(fs::file_size(session.file("bent.png")) > 20000);
    }
}

TEST_CASE("The device is switched in mid-edit, and the edit goes on", "[app][view]") {
    const ViewerSession session;
    const ProgramRun run = session.play(setup + "move @0.0,10,0\nwait\npress\nmove @0.0,10,0 20 30\nwait\n"
                                                "expect handles 1\ndevice 0\nwait\nexpect handles 1\n"
                                                "move @0.0,10,0 30 40\nrelease\nwait\nexpect edits 1\n",
                                        "cpu");
    CHECK(run.err.empty());
    CHECK(run.status == 0);
}

TEST_CASE("An occluder is put in the way and stays in the saved edit with its pose", "[app][view]") {
    const ViewerSession session;
    const ProgramRun run =
        session.play(setup + "occluder add ball sphere 0.1 0,0,2\nwait\nexpect occluders 1\n" + bend +
                         "occluder move ball 0,0,3\nwait\nsave " + session.file("ball.json") + "\nwait\n",
                     "cpu");
    CHECK(run.err.empty());
    REQUIRE(run.status == 0);
    const std::string recipe = content_of(session.file("ball.json"));
    CHECK_THAT(recipe, Catch::Contains("\"ball\""));
    // Once where the edit saw it, once where it is now.
    CHECK(recipe.find('3') != std::string::npos);
}

TEST_CASE("A session that is killed in mid-drag is recovered at the next start", "[app][view]") {
    const ViewerSession session;
    const ProgramRun killed = session.play(
        setup + bend + "expect edits 1\nmove @0.0,10,0\nwait\npress\nmove @0.0,10,0 10 10\nwait\ndie\n",
        "cpu");
    CHECK(killed.status == 128 + 9);
    const ProgramRun run = session.play("wait\nrecover\nwait\nexpect edits 1\nexpect unsaved yes\n", "cpu");
    CHECK(run.err.empty());
    CHECK(run.status == 0);
}

TEST_CASE("A script that cannot be played says the line, and a mesh that is not there is status 2",
          "[app][view]") {
    const ViewerSession session;
    const ProgramRun wrong = session.play("wait\nexpect edits 3\n", "cpu");
    CHECK(wrong.status == 2);
    CHECK_THAT(wrong.err, Catch::Contains(":2: expected edits 3, found 0"));
    RunLimits limits;
    limits.environment = {"ANVIL_STATE=off"};
    const ProgramRun none =
        run_anvil({"view", session.file("none.ply"), "--screenshot", session.file("none.png")}, limits);
    CHECK(none.status == 2);
    CHECK_THAT(none.err, Catch::Contains("none.ply"));
}

TEST_CASE("Without a display the viewer says so with status 3", "[app][view]") {
    RunLimits limits;
    limits.environment = {"DISPLAY=", "WAYLAND_DISPLAY=", "XDG_RUNTIME_DIR=/nonexistent"};
    const ProgramRun run = run_anvil({"view"}, limits);
    CHECK(run.status == 3);
    CHECK_THAT(run.err, Catch::Contains("display"));
}

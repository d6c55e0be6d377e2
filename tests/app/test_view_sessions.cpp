// Whole sessions, played to the window: the bundled scripts, and what goes wrong in between.
#include "tests/app/viewer_session.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

using namespace anvil;
namespace fs = std::filesystem;

namespace {

struct Example {
    std::string script;
    std::string sample;
    std::string vertices;
    int edits;
};

void check_session(const Example& example, const std::string& device) {
    INFO(example.script << " on " << device);
    const ViewerSession session;
    const std::string mesh = session.file("example.ply");
    REQUIRE(run_anvil({"sample", example.sample, "-o", mesh, "--vertices", example.vertices}).status == 0);
    const fs::path script =
        fs::path(ANVIL_TEST_DATA) / ".." / ".." / "app" / "example" / (example.script + ".script");
    session.check_history(content_of(script.string()), mesh, example.edits, device);
}

const std::string bend =
    "window 900 600\nwait\nview front\nframe\nradius 0.3\nmove @0.0,10,0\nwait\ndrag 30 40\n"
    "wait\nexpect edits 1\n";

} // namespace

TEST_CASE("A finger is bent by a script, undone, redone and forged bit for bit", "[app][view]") {
    check_session({"bend_finger", "hand", "6000", 1}, "cpu");
    check_session({"bend_finger", "hand", "6000", 1}, "0");
}

TEST_CASE("A head is turned with three anchors, undone, redone and forged bit for bit", "[app][view]") {
    check_session({"turn_head", "bust", "6000", 1}, "cpu");
    check_session({"turn_head", "bust", "6000", 1}, "0");
}

TEST_CASE("Fingers grip a ball, undone, redone and forged bit for bit", "[app][view]") {
    check_session({"grip_ball", "hand", "6000", 4}, "cpu");
    check_session({"grip_ball", "hand", "6000", 4}, "0");
}

TEST_CASE("A crease is made with new vertices, undone, redone and forged bit for bit", "[app][view]") {
    check_session({"crease", "icosphere", "642", 1}, "cpu");
    check_session({"crease", "icosphere", "642", 1}, "0");
}

TEST_CASE("A recipe whose mesh was moved asks for it and goes on with the one that is found", "[app][view]") {
    const ViewerSession session;
    const std::string recipe = session.file("bent.json");
    REQUIRE(session.play(bend + "save " + recipe + "\nwait\n", "cpu").status == 0);
    const std::string moved = session.file("moved.ply");
    fs::rename(session.mesh(), moved);
    const ProgramRun run = session.play("wait\nexpect notices 1\nfound " + moved +
                                            "\nwait\nexpect edits 1\nexpect unsaved yes\nsave " + recipe +
                                            "\nwait\nexpect unsaved no\n",
                                        "cpu", recipe);
    INFO(run.err);
    CHECK(run.err.empty());
    REQUIRE(run.status == 0);
    CHECK_THAT(content_of(recipe), Catch::Contains("moved.ply"));
}

TEST_CASE("A device that computes and is lost is followed by the CPU, and the edit is kept", "[app][view]") {
    const ViewerSession session;
    const ProgramRun run =
        session.play(bend +
                         "lose computing\nwait\nmove @v:0\nwait\nkey ctrl+z\nwait\nkey ctrl+shift+z\nwait\n"
                         "expect edits 1\nlose computing\nwait\nmove @0.0,10,0\nwait\ndrag 20 20\nwait\n"
                         "expect edits 2\nexpect device cpu\nsave " +
                         session.file("kept.json") + "\nsave " + session.file("kept.ply") + "\nwait\n",
                     "0");
    INFO(run.err);
    CHECK(run.err.empty());
    REQUIRE(run.status == 0);
    REQUIRE(
        run_anvil({"forge", session.file("kept.json"), "-o", session.file("forged.ply"), "--device", "cpu"})
            .status == 0);
    CHECK(content_of(session.file("forged.ply")) == content_of(session.file("kept.ply")));
}

TEST_CASE("A device that draws and is lost costs the window, but no edit", "[app][view]") {
    const ViewerSession session;
    const ProgramRun run = session.play(bend +
                                            "lose drawing\nwait\nwait\nexpect edits 1\nexpect unsaved yes\n"
                                            "expect notices 1\nmove @0.0,10,0\nwait\ndrag 20 20\nwait\n"
                                            "expect edits 2\nscreenshot " +
                                            session.file("after.png") + "\n",
                                        "cpu");
    INFO(run.err);
    CHECK(run.err.empty());
    REQUIRE(run.status == 0);
    CHECK(fs::file_size(session.file("after.png")) > 20000);
}

#include "tests/app/viewer_session.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

using namespace anvil;

namespace {

const std::string setup = "window 900 600\nwait\nview front\nframe\nradius 0.25\n";

nlohmann::json recipe_of(const std::string& file) {
    return nlohmann::json::parse(std::ifstream(file));
}

} // namespace

TEST_CASE("A selection made by a box is pinned, stays through a refining edit and is in the saved recipe",
          "[app][view]") {
    const ViewerSession session;
    const std::string json = session.file("pinned.json");
    const ProgramRun run =
        session.play(setup +
                         "key b\nmove 440 60\ndrag 60 60\nwait\nkey plus\nwait\nkey minus\nwait\nkey "
                         "ctrl+p\nexpect undo \"\"\n" +
                         "key g\nrefine 0.01\nmove @0.0,10,0\nwait\ndrag 30 40\nwait\nexpect edits 1\n" +
                         "key ctrl+z\nwait\nkey ctrl+shift+z\nwait\nexpect edits 1\nsave " + json +
                         "\nsave " + session.file("pinned.ply") +
                         "\nwait\nkey h\nwait\nexpect selected 0\nselect show\nwait\nexpect hidden 0\n" +
                         "screenshot " + session.file("pinned.png"),
                     "cpu");
    CHECK(run.err.empty());
    REQUIRE(run.status == 0);
    const auto edit = recipe_of(json)["edits"][0];
    CHECK(edit["pinned"].size() > 20);
    REQUIRE(run_anvil({"forge", json, "-o", session.file("forged.ply"), "--device", "cpu"}).status == 0);
    CHECK(content_of(session.file("forged.ply")) == content_of(session.file("pinned.ply")));
}

TEST_CASE("A line drawn along the surface is a handle, and a mirrored drag moves both sides", "[app][view]") {
    const ViewerSession session;
    const std::string line = session.file("line.json");
    const ProgramRun run = session.play(
        setup +
            "key l\nmove 430 350\nclick\nmove 470 350\nclick\nmove 470 390\nclick\nwait\nkey enter\nwait\n" +
            "expect handles 1\nexpect anchors 1\nmirror x 0.02\nkey g\nkey n\ntype 0.05\nwait\nkey "
            "enter\nwait\n" +
            "expect edits 1\nsave " + line + "\nwait\nscreenshot " + session.file("line.png"),
        "0");
    CHECK(run.err.empty());
    REQUIRE(run.status == 0);
    const auto edit = recipe_of(line)["edits"][0];
    CHECK(edit["anchors"][0]["at"][0]["polyline"].size() == 3);
    CHECK(edit["mirror"]["axis"] == "x");
    CHECK(edit["mirror"]["origin"] == 0.02);
    CHECK(edit["handles"].size() == 1);
}

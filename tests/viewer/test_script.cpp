#include "app/viewer/script.h"
#include "engine/core/error.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <fstream>

using namespace anvil;

namespace {

std::vector<ScriptLine> lines_of(const std::string& text) {
    const ScratchFolder folder;
    const std::string file = folder / "script.txt";
    std::ofstream(file) << text;
    return read_script(file);
}

} // namespace

TEST_CASE("a script is read line by line, quotes keep spaces, comments are left out") {
    const auto lines =
        lines_of("# a comment\n\nopen \"my mesh.ply\"\n  move @f:3:0.2,0.3,0.5 4 -5\r\nwait\n");
    REQUIRE(lines.size() == 3);
    CHECK(lines[0].number == 3);
    CHECK(lines[0].arguments == std::vector<std::string>{"my mesh.ply"});
    CHECK(lines[1].arguments == std::vector<std::string>{"@f:3:0.2,0.3,0.5", "4", "-5"});
    CHECK(lines[2].word == "wait");
}

TEST_CASE("a script that cannot be played says where and why") {
    CHECK_THROWS_WITH(lines_of("wait\nfly away\n"),
                      Catch::Contains(":2:") && Catch::Contains("\"fly\"") && Catch::Contains("screenshot"));
    CHECK_THROWS_WITH(lines_of("window 3\n"), Catch::Contains("2 arguments"));
    CHECK_THROWS_AS(read_script("no such file"), InputError);
    CHECK_THROWS_AS(key_event("ctrl+hyper", true), InputError);
    CHECK_THROWS_AS(script_number("1e999"), InputError);
    CHECK_THROWS_AS(script_number("3x"), InputError);
}

TEST_CASE("keys are named as people write them") {
    const InputEvent event = key_event("ctrl+shift+z", true);
    CHECK(event.key == 'Z');
    CHECK(event.modifiers == Modifiers{.shift = true, .control = true});
    CHECK(key_event("x", true).key == 'X');
    CHECK(key_event("F1", true).key != key_event("f", true).key);
    CHECK(key_event("escape", false).kind == InputEvent::Kind::key_up);
}

// What the viewer's gizmo, recorded motions and paths, and the list of edits do, by scripts.
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>

using namespace anvil;

namespace {

class Stage {
  public:
    Stage() {
        REQUIRE(run_anvil({"sample", "hand", "-o", file("hand.ply"), "--vertices", "4000"}).status == 0);
    }

    std::string file(const std::string& name) const { return folder_ / name; }

    /// Seen from the front, as all scripts here begin.
    void play(const std::string& script, const std::vector<std::string>& where = {"--device", "cpu"}) const {
        std::ofstream(file("script.txt")) << "window 900 600\nwait\nview front\nframe\n"
                                          << script << "\nwait\n";
        RunLimits limits;
        limits.environment = {"ANVIL_STATE=off", "ANVIL_CACHE=off", "ANVIL_DATA=" + file("data")};
        limits.seconds = 300;
        REQUIRE(std::getenv("DISPLAY") != nullptr); // tests/run gives one; by hand: xvfb-run -a
        std::vector<std::string> arguments{"view", file("hand.ply"), "--script", file("script.txt")};
        arguments.insert(arguments.end(), where.begin(), where.end());
        const ProgramRun run = run_anvil(arguments, limits);
        CHECK(run.err.empty());
        REQUIRE(run.status == 0);
    }

    /// What was saved is what the recipe forges.
    void check_saved(const std::string& name) const {
        REQUIRE(
            run_anvil({"forge", file(name + ".json"), "-o", file(name + "-forged.ply"), "--device", "cpu"})
                .status == 0);
        CHECK(content_of(file(name + "-forged.ply")) == content_of(file(name + ".ply")));
    }

    std::string saving(const std::string& name) const {
        return "\nwait\nsave " + file(name + ".json") + "\nsave " + file(name + ".ply") + "\nwait\n";
    }

  private:
    ScratchFolder folder_;
};

} // namespace

TEST_CASE("An occluder is moved by its gizmo in one step, and past edits keep where it was", "[app][view]") {
    const Stage stage;
    stage.play("occluder add ball sphere 0.1 0.2,0.5,0.4\nwait\nexpect gizmo \"\"\n"
               "occluder select ball\nexpect gizmo ball\n"
               "move @gizmo.move-x\npress\ntype 0.25\nrelease\nwait\nexpect undo \"occluder's place\"\n"
               "move @gizmo.turn-y\npress\ntype 30\nkey escape\nrelease\nwait\n"
               "key ctrl+z\nwait\nexpect undo \"new occluder\"\nkey ctrl+shift+z" +
               stage.saving("moved"));
    CHECK_THAT(content_of(stage.file("moved.json")), Catch::Contains("0.45,\n          0.5,\n          0.4"));
}

TEST_CASE("A hammer that was recorded by a drag forges the same mesh headless", "[app][view]") {
    const Stage stage;
    stage.play("view right\nframe\noccluder add ball sphere 0.12 0.05,0.4,0.4\nwait\noccluder select ball\n"
               "occluder record on\nmove @gizmo.move-z\npress\ntype 0.25-\nwait\nexpect touching "
               "yes\nrelease\nwait\n"
               "expect edits 0\nexpect pending yes\nkey enter\nwait\nexpect edits 1\nexpect pending no" +
               stage.saving("hammer") + "key ctrl+z\nwait\nexpect moved 0\nkey ctrl+y\nwait\nexpect edits 1");
    CHECK_THAT(content_of(stage.file("hammer.json")), Catch::Contains("\"motion\""));
    stage.check_saved("hammer");
    CHECK(content_of(stage.file("hammer.ply")) != content_of(stage.file("hand.ply")));
}

TEST_CASE("A mesh that becomes an occluder in the window is baked on the device as on the CPU",
          "[app][view]") {
    const Stage stage;
    REQUIRE(run_anvil({"sample", "bust", "-o", stage.file("tool.ply"), "--vertices", "600"}).status == 0);
    // Seen from the right, a finger is dragged against the bust that stands before it.
    const auto session = [&](const std::string& name) {
        return "occluder add tool " + stage.file("tool.ply") +
               " 1 0.05,0.4,1.2\nwait\noccluder move tool 0.06,0.7,0.35\nwait\n"
               "view right\nframe\nradius 0.5\nmove @0.06,0.7,-5\nwait\npress\n"
               "move @0.06,0.7,-5 -40 0\nwait\nmove @0.06,0.7,-5 -80 0\nwait\nexpect touching yes\n"
               "release\nwait\nexpect edits 1\nexpect notices 0" +
               stage.saving(name);
    };
    for (const std::string where : {"cpu", "device"}) {
        stage.play(session(where), {"--device", "0", "--bake", where});
    }
    CHECK(content_of(stage.file("device.ply")) == content_of(stage.file("cpu.ply")));
    CHECK(content_of(stage.file("cpu.ply")) != content_of(stage.file("hand.ply")));
    RunLimits limits;
    limits.environment = {"ANVIL_STATE=off"};
    const ProgramRun nowhere = run_anvil({"view", "--device", "cpu", "--bake", "device"}, limits);
    CHECK(nowhere.status == 2);
    CHECK_THAT(nowhere.err, Catch::Contains("--bake device"));
}

TEST_CASE("A path that is followed, a swelling and refinement are what the recipe says", "[app][view]") {
    const Stage stage;
    stage.play(
        "occluder add ball sphere 0.1 0.06,0.8,0.2\nwait\nradius 0.4\npath on\ndilation depth 0.5\n"
        "refine shape 0.02 flip\nmove @0.06,10,0\nwait\npress\nmove @0.06,10,0 10 40\nmove @0.06,10,0 60 60\n"
        "wait\nrelease\nwait\nexpect edits 1" +
        stage.saving("path"));
    const std::string recipe = content_of(stage.file("path.json"));
    CHECK_THAT(recipe, Catch::Contains("\"path\"") && Catch::Contains("\"dilation\"") &&
                           Catch::Contains("\"flip\": true"));
    stage.check_saved("path");
}

TEST_CASE("An occluder that is off is left out of the edit, and can be left out of a past one",
          "[app][view]") {
    const Stage stage;
    const std::string pull = "move @0.0,10,0\nwait\ndrag 20 30\nwait\n";
    stage.play("occluder add ball sphere 0.1 0,0,2\nwait\nradius 0.3\noccluder off ball\n" + pull +
               stage.saving("off") + "edit 0 remove\nwait\noccluder on ball\n" + pull + stage.saving("on") +
               "edit 0 without ball" + stage.saving("without"));
    CHECK_THAT(content_of(stage.file("off.json")), Catch::Contains("\"occluders\": []"));
    CHECK_THAT(content_of(stage.file("on.json")), !Catch::Contains("\"occluders\": []"));
    CHECK_THAT(content_of(stage.file("without.json")), Catch::Contains("\"occluders\": []"));
}

TEST_CASE("Switching an occluder off is undone and redone as a step, also under an edit", "[app][view]") {
    const Stage stage;
    const std::string pull = "move @0.0,10,0\nwait\ndrag 20 30\nwait\n";
    stage.play("occluder add ball sphere 0.1 0,0,2\nwait\nradius 0.3\noccluder off ball\nwait\n"
               "expect undo \"switching ball off\"\nkey ctrl+z\nwait\nexpect undo \"new occluder\"\n" +
               pull + stage.saving("on") + "key ctrl+z\nwait\noccluder off ball\nwait\nkey ctrl+z\nwait\n" +
               "key ctrl+shift+z\nwait\nexpect undo \"switching ball off\"\n" + pull + stage.saving("off"));
    CHECK_THAT(content_of(stage.file("on.json")), !Catch::Contains("\"occluders\": []"));
    CHECK_THAT(content_of(stage.file("off.json")), Catch::Contains("\"occluders\": []"));
}

TEST_CASE("Any past edit is changed, moved in the list and undone again", "[app][view]") {
    const Stage stage;
    stage.play(
        "radius 0.3\nmove @0.0,10,0\nwait\ndrag 20 30\nwait\nmove @0.25,0.9,0\nwait\ndrag 30 -10\nwait\n"
        "expect edits 2" +
        stage.saving("before") +
        "edit 0 radius 0.2\nwait\nedit 0 shape linear\nwait\nedit 0 handle 0 by 0,-0.05,0.1\nwait\n"
        "edit 1 up\nwait\nedit 0 refine 0.05" +
        stage.saving("changed") +
        "key ctrl+z\nwait\nexpect undo \"order of edits\"\nkey ctrl+z\nwait\nkey ctrl+z\nwait\nexpect edits "
        "2" +
        stage.saving("again"));
    stage.check_saved("changed");
    CHECK(content_of(stage.file("changed.ply")) != content_of(stage.file("before.ply")));
    CHECK(content_of(stage.file("again.ply")) == content_of(stage.file("before.ply")));
}

TEST_CASE("Own curves are kept and used by their names", "[app][view]") {
    const Stage stage;
    stage.play("shape rim\ncurve save mine\nshape smooth\ncurve load mine\nmove @0.0,10,0\nwait\nradius 0.3\n"
               "drag 20 30\nwait\nexpect edits 1" +
               stage.saving("rim"));
    CHECK_THAT(content_of(stage.file("rim.json")), Catch::Contains("\"shape\": \"rim\""));
    CHECK(content_of(stage.file("data/curves/mine.json")) == "\"rim\"\n");
}

TEST_CASE("The count that refinement would add is known before it is taken, and is what it then adds",
          "[app][view]") {
    const Stage stage;
    stage.play("radius 0.3\nrefine 0.01\nmove @0.0,10,0\nwait\nclick\nmove @0.0,10,0\npress\n"
               "move @0.0,10,0 20 30\nrelease\nwait\nexpect edits 0\nscreenshot " +
               stage.file("preview.png") + "\nwait\nkey enter\nwait\nexpect edits 1\nrefine off" +
               stage.saving("fine"));
    stage.check_saved("fine");
}

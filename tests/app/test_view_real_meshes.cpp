// Whole sessions on scanned and captured meshes, where these are at hand.
#include "tests/app/viewer_session.h"

#include <catch2/catch.hpp>
#include <cstdlib>

using namespace anvil;

namespace {

/// Plays the session to the mesh of that name, if there is one, once with each device.
void check_real(const std::string& name, const std::string& script, int edits,
                const std::vector<std::string>& devices) {
    const char* folder = std::getenv("ANVIL_TEST_MESHES");
    if (folder == nullptr) {
        WARN("ANVIL_TEST_MESHES names no folder of real meshes");
        return;
    }
    for (const std::string& device : devices) {
        INFO(name << " on " << device);
        const ViewerSession session;
        session.check_history(script, std::string(folder) + "/" + name, edits, device);
    }
}

const std::string begin = "window 900 600\nwait\n";

} // namespace

TEST_CASE("A finger of a real hand is bent, undone, redone and forged bit for bit", "[app][view]") {
    check_real("hand_closed.obj",
               begin + "view -1,0.2,0.3\nframe\nradius 0.4\nmove @v:1082\nwait\npress\n"
                       "move @v:1082 90 30\nmove @v:1082 170 110\nrelease\nwait\n",
               1, {"cpu", "0"});
}

TEST_CASE("A real head is turned with three anchors, undone, redone and forged bit for bit", "[app][view]") {
    check_real("nefertiti.obj",
               begin + "up z\nview top\nframe\nradius 330\nmove @0,60,400\nwait\nclick\nwait\nkey a\n"
                       "move @0,60,400\nclick\nview front\nmove @0,-300,0\nclick\nview 0,1,0.5\n"
                       "move @0,160,170\nclick\nwait\nexpect handles 1\nexpect anchors 3\nview front\n"
                       "key r\nkey z\ntype 30\nwait\nkey enter\nwait\n",
               1, {"0"});
}

TEST_CASE("A real hand grips a ball, undone, redone and forged bit for bit", "[app][view]") {
    const auto close = [](const char* tip, const char* drag) {
        return std::string("move @v:") + tip + "\nwait\ndrag " + drag + "\nwait\n";
    };
    check_real("hand_closed.obj",
               begin +
                   "view 1,0.1,0\nframe\noccluder add ball sphere 0.16 0.02,0.47,0.27\nwait\nradius 0.45\n" +
                   close("3445", "-120 60") + close("3059", "-160 130") + "expect touching yes\n" +
                   close("2146", "-120 230") + "expect touching yes\nview -1,0.1,0\nwait\n" +
                   close("1082", "110 220") + "expect touching yes\nexpect notices 0\n",
               4, {"cpu", "0"});
}

TEST_CASE("A real face gets a crease with new vertices, undone, redone and forged bit for bit",
          "[app][view]") {
    check_real("nefertiti.obj",
               begin + "up z\nview front\nframe\nkey l\nmove @-60,-150,-60\nwait\nclick\n"
                       "move @0,-190,-75\nclick\nmove @60,-150,-60\nclick\nwait\nkey enter\nwait\n"
                       "expect handles 1\nradius 45\nshape sharp\nrefine 0.003\nkey g\nkey n\n"
                       "type -12\nwait\nkey enter\nwait\n",
               1, {"cpu"});
}

// What happens to the window, and what is seen in it.
#include "tests/app/screenshot.h"
#include "tests/app/viewer_session.h"

#include "engine/mesh/mesh_reader.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

using namespace anvil;
namespace fs = std::filesystem;

namespace {

const std::string front = "window 900 600\nwait\nview front\nframe\nradius 0.3\n";
const std::string bend = "move @0.0,10,0\nwait\ndrag 30 40\nwait\n";

void check_run(const ProgramRun& run) {
    INFO(run.err);
    CHECK(run.err.empty());
    REQUIRE(run.status == 0);
}

Mesh mesh_of(const std::string& file) {
    Log log;
    return read_mesh(file, log);
}

size_t sum(const std::vector<size_t>& columns, size_t first, size_t end) {
    return std::accumulate(columns.begin() + static_cast<std::ptrdiff_t>(first),
                           columns.begin() + static_cast<std::ptrdiff_t>(end), size_t{0});
}

} // namespace

TEST_CASE("Marks are faint where the surface hides them, and full where it does not", "[app][view]") {
    const ViewerSession session;
    // One pin in the palm, seen from its side and from behind the hand.
    check_run(session.play(
        "window 900 600\nwait\nkey tab\nview front\nframe\nkey p\nmove @0,0.4,0.3\nclick\nwait\n"
        "expect pins 1\nmove 5 300\nwait\nscreenshot " +
            session.file("seen.png") + "\nview 0,0,-1\nwait\nscreenshot " + session.file("hidden.png") + "\n",
        "cpu"));
    const auto pin_pixels = [&](const char* name) {
        return read_screenshot(session.file(name)).count(230, 90, 160, 12);
    };
    CHECK(pin_pixels("seen.png") >= 40); // a square of 8 pixels, its rim blended
    CHECK(pin_pixels("hidden.png") == 0);
    // There it is, though: the skin takes on three tenths of it.
    const Screenshot hidden = read_screenshot(session.file("hidden.png"));
    size_t tinged = 0;
    for (int y = 0; y < hidden.height; ++y) {
        for (int x = 0; x < hidden.width; ++x) {
            const size_t at = 3 * (static_cast<size_t>(y) * 900 + static_cast<size_t>(x));
            tinged += hidden.rgb[at + 2] > hidden.rgb[at + 1] + 5 && hidden.rgb[at] > hidden.rgb[at + 1] + 25
                          ? 1
                          : 0;
        }
    }
    CHECK(tinged >= 30);
}

TEST_CASE("A window that is minimized in mid-drag, resized, and whose surface is lost goes on where it was",
          "[app][view]") {
    const ViewerSession session;
    check_run(
        session.play(front +
                         "move @0.0,10,0\nwait\npress\nmove @0.0,10,0 10 20\nwait\nminimize on\nwait\n"
                         "move @0.0,10,0 20 30\nwait\nexpect handles 1\nminimize off\nlose surface\nwait\n"
                         "move @0.0,10,0 30 40\nrelease\nwait\nexpect edits 1\nwindow 200 150\nwait\nwindow "
                         "640 480\nlose surface\nwait\nscreenshot " +
                         session.file("after.png") + "\nkey ctrl+z\nwait\nexpect edits 0\n",
                     "cpu"));
    const Screenshot after = read_screenshot(session.file("after.png"));
    CHECK(after.width == 640);
    CHECK(after.height == 480);
    CHECK(after.count(after.rgb[0], after.rgb[1], after.rgb[2], 0) < 640 * 480 / 2); // not one colour
}

TEST_CASE(
    "A question about a file waits for the one before, and leaves the mouse to the surface when both are "
    "answered",
    "[app][view]") {
    const ViewerSession session;
    check_run(session.play(
        front + "key ctrl+o\nwait\nkey ctrl+shift+s\nwait\nkey F12\nwait\nkey escape\nsleep 0.2\nwait\n" +
            bend + "expect edits 1\n",
        "cpu"));
}

TEST_CASE("A file that is dropped answers the dialog that asks for one", "[app][view]") {
    const ViewerSession session;
    const std::string other = session.file("other.ply");
    REQUIRE(run_anvil({"sample", "icosphere", "-o", other, "--vertices", "642"}).status == 0);
    check_run(
        session.play(front + "key ctrl+o\nsleep 0.1\nwait\ndrop " + other +
                         "\nwait\nexpect vertices 642\nradius 0.5\nmove @0,0.3,5\nwait\ndrag 20 20\nwait\n"
                         "expect edits 1\n",
                     "cpu"));
    // Where a recipe's mesh is asked for, it is that mesh.
    const std::string recipe = session.file("bent.json");
    check_run(session.play(front + bend + "save " + recipe + "\nwait\n", "cpu"));
    const std::string moved = session.file("moved.ply");
    fs::rename(session.mesh(), moved);
    check_run(session.play("wait\nexpect notices 1\nsleep 0.1\ndrop " + moved + "\nwait\nexpect edits 1\n",
                           "cpu", recipe));
}

TEST_CASE("A file that cannot be opened costs neither the edit under way nor the document", "[app][view]") {
    const ViewerSession session;
    const std::string text = session.file("notes.txt");
    const std::string broken = session.file("broken.ply");
    std::ofstream(text) << "no mesh";
    std::ofstream(broken) << "ply\nformat ascii 1.0\nelement vertex 3\n";
    const std::string gone = session.file("gone.ply");
    std::string script = front + "move @0.0,10,0\nwait\nclick\nwait\nexpect handles 1\n";
    int said = 0;
    for (const std::string& file : {text, broken, gone, session.file("")}) {
        script += "drop " + file + "\nwait\nexpect handles 1\nexpect pending yes\nexpect notices " +
                  std::to_string(++said) + "\n";
    }
    check_run(
        session.play(script + "key g\ntype 0.05\nkey x\nwait\nkey enter\nwait\nexpect edits 1\n", "cpu"));
}

TEST_CASE("An edit under way counts as unsaved: another file is opened only when that is answered",
          "[app][view]") {
    const ViewerSession session;
    const std::string other = session.file("other.ply");
    REQUIRE(run_anvil({"sample", "icosphere", "-o", other, "--vertices", "642"}).status == 0);
    const std::string begun = front + "move @0.0,10,0\nwait\nclick\nwait\nexpect handles 1\n";
    const std::string moved = "key g\nkey x\ntype 0.05\nwait\nclick\nwait\nexpect pending yes\n";
    const std::string dropped = "drop " + other + "\nwait\nsleep 0.1\nwait\n";
    check_run(
        session.play(begun + moved + dropped +
                         "expect handles 1\nkey escape\nsleep 0.1\nwait\nkey enter\nwait\nexpect edits 1\n",
                     "cpu"));
    check_run(session.play(begun + dropped + "expect vertices 642\n", "cpu")); // nothing is moved
}

TEST_CASE("A double click in a dialog enters a folder and opens a file", "[app][view]") {
    const ViewerSession session;
    const std::string folder = session.file("deep");
    fs::create_directory(folder);
    REQUIRE(run_anvil({"sample", "icosphere", "-o", folder + "/ball.ply", "--vertices", "642"}).status == 0);
    // The first entry: folders come first.
    const std::string twice = "move 200 163\nclick\nclick\nsleep 0.2\nwait\n";
    check_run(session.play(front + "key ctrl+o\nsleep 0.2\ntype " + session.file("") +
                               "\nsleep 0.1\nkey enter\nsleep 0.2\n" + twice + twice +
                               "expect vertices 642\n",
                           "cpu"));
}

TEST_CASE("A recipe that cannot be saved stays unsaved, with all its edits", "[app][view]") {
    const ViewerSession session;
    check_run(session.play(front + bend + "save " + session.file("nowhere/bent.json") +
                               "\nwait\nexpect notices 1\nexpect unsaved yes\nexpect edits 1\nsave " +
                               session.file("nowhere/bent.ply") +
                               "\nwait\nexpect notices 2\nexpect edits 1\nsave " + session.mesh() +
                               "\nwait\nexpect notices 3\nsave " + session.file("bent.json") +
                               "\nwait\nexpect unsaved no\n",
                           "cpu"));
}

TEST_CASE("What is selected fills the window when it is framed", "[app][view]") {
    const ViewerSession session;
    const std::string json = session.file("framed.json");
    // The box is around a fingertip, far from the window's middle; then the middle shows it.
    check_run(
        session.play(front +
                         "key b\nmove @0.0,10,0 -40 -40\ndrag 80 80\nwait\nkey f\nwait\nkey g\nradius 0.1\n"
                         "move 450 300\nwait\ndrag 40 0\nwait\nexpect edits 1\nsave " +
                         json + "\nwait\n",
                     "cpu"));
    const Mesh hand = mesh_of(session.mesh());
    const Vec3 tip = *std::max_element(hand.positions.begin(), hand.positions.end(),
                                       [](const Vec3& a, const Vec3& b) { return a.y < b.y; });
    const auto handle = nlohmann::json::parse(std::ifstream(json))["edits"][0]["handles"][0];
    REQUIRE(handle["at"].contains("face"));
    const Triangle& face = hand.triangles.at(handle["at"]["face"].get<size_t>());
    double nearest = infinity;
    for (const uint32_t v : face) {
        nearest = std::min(nearest, glm::length(hand.positions[v] - tip));
    }
    CHECK(nearest < 0.12); // the hand is 1.2 high
    // 40 pixels are far less than before: the hand filled 600, what is selected fills them now.
    const auto by = handle["by"].get<std::vector<double>>();
    CHECK(std::hypot(by[0], by[1], by[2]) < 0.5 * 40 * 1.2 / 600);
}

TEST_CASE("A mirrored drag moves the other side as its image, already while it is dragged", "[app][view]") {
    const ViewerSession session;
    const std::string ball = session.file("ball.ply");
    REQUIRE(run_anvil({"sample", "icosphere", "-o", ball, "--vertices", "2562"}).status == 0);
    check_run(session.play(
        "window 900 600\nwait\nkey tab\nview front\nframe\nmirror x\nradius 0.4\nmove 5 300\nwait\n"
        "screenshot " +
            session.file("before.png") +
            "\nmove @0.75,0.2,2\nwait\npress\nmove @0.75,0.2,2 30 10\nwait\nscreenshot " +
            session.file("during.png") + "\nrelease\nwait\nexpect edits 1\nsave " + session.file("both.ply") +
            "\nwait\n",
        "cpu", ball));
    // Above the status bar.
    const auto changed = changed_by_column(read_screenshot(session.file("before.png")),
                                           read_screenshot(session.file("during.png")), 540, 8);
    const size_t left = sum(changed, 0, 420);
    const size_t right = sum(changed, 480, 900);
    CHECK(left > 1000);
    CHECK(right > 1000);
    CHECK(static_cast<double>(std::min(left, right)) > 0.7 * static_cast<double>(std::max(left, right)));

    const Mesh before = mesh_of(ball);
    const Mesh after = mesh_of(session.file("both.ply"));
    size_t moved = 0;
    double worst = 0;
    for (size_t v = 0; v < before.positions.size(); ++v) {
        const Vec3 image = before.positions[v] * Vec3(-1, 1, 1);
        const auto other = std::min_element(
            before.positions.begin(), before.positions.end(),
            [&](const Vec3& a, const Vec3& b) { return glm::length(a - image) < glm::length(b - image); });
        REQUIRE(glm::length(*other - image) < 1e-5); // this sphere is its own image
        const auto w = static_cast<size_t>(other - before.positions.begin());
        const Vec3 here = after.positions[v] - before.positions[v];
        const Vec3 there = (after.positions[w] - before.positions[w]) * Vec3(-1, 1, 1);
        moved += glm::length(here) > 0.01 ? 1 : 0;
        worst = std::max(worst, glm::length(here - there));
    }
    CHECK(moved > 100);
    CHECK(worst < 1e-3); // distances on either side are those of other triangles
}

#include "tests/app/forge_folder.h"

#include <catch2/catch.hpp>
#include <sstream>

using namespace anvil;

namespace {

/// A strip of quads with a seam in its texture, two groups and two materials.
const std::string strip = R"(mtllib skin.mtl
v 0 0 0 1 0 0
v 1 0 0 0 1 0
v 1 1 0 0 0 1
v 0 1 0 1 1 0
v 2 0 0 1 0 1
v 2 1 0 0 1 1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vt 0.25 0.75
g left
usemtl red
f 1/1 2/2 3/3 4/4
g right
usemtl blue
f 2/5 5/2 6/3 3/4
)";

std::vector<std::string> lines_of_kind(const std::string& text, const std::string& kind) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        if (line.rfind(kind + " ", 0) == 0) {
            lines.push_back(line);
        }
    }
    return lines;
}

} // namespace

TEST_CASE("polygons, colours, texture corners, groups and materials of an OBJ survive an edit",
          "[app][forge]") {
    const ForgeFolder folder;
    folder.write("strip.obj", strip);
    folder.write("lift.json", R"({"anvil": 1, "mesh": "strip.obj", "edits": [{"kind": "translate",
        "radius": 0.9, "handles": [{"at": {"vertex": 0}, "by": [0, 0, 0.5]}]}]})");
    REQUIRE(folder.forge({"lift.json", "--device", "cpu", "-o", "out.obj"}).status == 0);
    const std::string out = content_of(folder.path("out.obj"));
    for (const char* kind : {"mtllib", "vt", "g", "usemtl"}) {
        INFO(kind);
        CHECK(lines_of_kind(out, kind) == lines_of_kind(strip, kind));
    }
    CHECK(lines_of_kind(out, "f") == lines_of_kind(strip, "f"));
    const auto vertices = lines_of_kind(out, "v");
    const auto before = lines_of_kind(strip, "v");
    REQUIRE(vertices.size() == before.size());
    CHECK_THAT(vertices[0], Catch::StartsWith("v 0 0 0.5") && Catch::EndsWith("1 0 0"));
    for (size_t v = 1; v < before.size(); ++v) {
        CHECK(vertices[v] == before[v]); // nothing else lies within the radius
    }
}

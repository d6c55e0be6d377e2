#include "tests/app/refused_recipe.h"

#include <catch2/catch.hpp>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

using namespace anvil;

namespace {

using Grid = openvdb::FloatGrid;

Grid::Ptr named(Grid::Ptr grid, const std::string& name, openvdb::GridClass kind) {
    grid->setName(name);
    grid->setGridClass(kind);
    return grid;
}

/// mixed.vdb: a fog volume, a level set without a voxel, and two good ones. fog.vdb and empty.vdb: one each.
void write_level_sets(const ForgeFolder& folder) {
    openvdb::initialize();
    const auto fog = named(Grid::create(0), "density", openvdb::GRID_FOG_VOLUME);
    fog->tree().setValueOn(openvdb::Coord(0, 0, 0), 1);
    const auto empty = named(Grid::create(0.15F), "void", openvdb::GRID_LEVEL_SET);
    openvdb::GridPtrVec mixed{fog, empty};
    for (const std::string name : {"left", "right"}) {
        const auto ball = openvdb::tools::createLevelSetSphere<Grid>(0.3F, openvdb::Vec3f(0), 0.05F);
        mixed.push_back(named(ball, name, openvdb::GRID_LEVEL_SET));
    }
    const auto write = [&](const std::string& file, const openvdb::GridPtrVec& grids) {
        openvdb::io::File(folder.path(file)).write(grids);
    };
    write("mixed.vdb", mixed);
    write("fog.vdb", {fog});
    write("empty.vdb", {empty});
    write("none.vdb", {});
}

std::string with_shape(const std::string& shape, const std::string& more = "") {
    return recipe_text(pull_edit(), R"([{"name": "tool", "shape": )" + shape + more + "}]");
}

std::string with_edit(const std::string& edit) {
    return recipe_text("[" + edit + "]", R"([{"name": "tool", "shape": {"sphere": {"radius": 0.3}}}])");
}

std::string with_resolution(const std::string& resolution) {
    return with_shape(R"({"torus": {"major": 0.4, "minor": 0.2}})",
                      R"(, "field": {"kind": "adaptive", "resolution": )" + resolution + "}");
}

const std::vector<RefusedRecipe> bad_occluders = {
    {"a fog volume", with_shape(R"({"vdb": "fog.vdb"})"), {"tool", "fog.vdb", "no level set", "density"}},
    {"a fog volume by its name",
     with_shape(R"({"vdb": "mixed.vdb", "grid": "density"})"),
     {"mixed.vdb", "fog volume", "convert"}},
    {"an empty level set", with_shape(R"({"vdb": "empty.vdb"})"), {"empty.vdb", "empty"}},
    {"a file without grids", with_shape(R"({"vdb": "none.vdb"})"), {"none.vdb", "no grid"}},
    {"a wrong grid name",
     with_shape(R"({"vdb": "mixed.vdb", "grid": "lefft"})"),
     {"mixed.vdb", "lefft", "\"left\"", "\"right\"", "density"}},
    {"several grids and no name",
     with_shape(R"({"vdb": "mixed.vdb"})"),
     {"several level sets", "\"left\"", "\"right\""}},
    {"a mesh without triangles", with_shape(R"({"mesh": "points.obj"})"), {"tool", "points.obj", "no face"}},
    {"a mesh of points and a line", with_shape(R"({"mesh": "line.obj"})"), {"line.obj", "no face"}},
    {"no resolution", with_resolution("0"), {"occluders[0]", "resolution", "8", "1024", "0"}},
    {"a resolution beyond all memory", with_resolution("1e6"), {"resolution", "1024"}},
    {"a resolution that is no whole number", with_resolution("64.5"), {"resolution", "64.5"}},
    {"a scale along one axis",
     with_shape(R"({"sphere": {"radius": 0.3}})", R"(, "transform": {"scale": [1, 2, 1]})"),
     {"occluders[0]", "scale", "uniform"}},
    {"a scale along one axis in an edit",
     with_edit(R"({"kind": "translate", "radius": 1, "handles": [{"at": {"vertex": 3}, "by": [0, 0.1, 0]}],
                   "occluders": [{"name": "tool", "transform": {"scale": [1, 1, 3]}}]})"),
     {"edits[0]", "scale", "uniform"}},
    {"a path of one point",
     with_edit(R"({"kind": "translate", "radius": 1,
                   "handles": [{"at": {"vertex": 3}, "path": [[0, 0, 0]]}]})"),
     {"edits[0].handles[0].path", "at least two"}},
    {"a motion of one pose",
     with_edit(R"({"kind": "translate", "occluders": [{"name": "tool",
                   "motion": [{"at": 0, "translate": [0, 1, 0]}]}]})"),
     {"edits[0].occluders[0].motion", "at least two"}},
};

} // namespace

TEST_CASE("A bad occluder, path or motion is status 2 and a line that says what would mend it",
          "[app][forge]") {
    const ForgeFolder folder;
    write_level_sets(folder);
    folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    folder.write("line.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n");
    for (const RefusedRecipe& bad : bad_occluders) {
        INFO(bad.what);
        check_refused(folder, bad);
        CHECK_FALSE(folder.has("out.ply"));
    }
}

TEST_CASE("A mesh without triangles cannot be forged, with status 2 and the reason", "[app][forge]") {
    const ForgeFolder folder;
    folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    folder.write("pull.json", recipe_text(pull_edit()));
    const ProgramRun run = folder.forge({"pull.json", "--mesh", "points.obj", "--device", "cpu"});
    INFO(run.err);
    CHECK(run.status == 2);
    CHECK_THAT(run.err, Catch::Contains("points.obj"));
}

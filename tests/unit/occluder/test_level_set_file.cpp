#include "engine/core/atomic_file.h"
#include "engine/core/error.h"
#include "engine/core/read_file.h"
#include "engine/mesh/health.h"
#include "engine/occluder/level_set_file.h"
#include "engine/occluder/mesh_distance.h"
#include "engine/occluder/shape_nodes.h"
#include "engine/occluder/solid.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <random>

using namespace anvil;

namespace {

using Grid = openvdb::FloatGrid;

std::shared_ptr<const ExactDistance> solid_of(const OccluderShape& shape) {
    return true_distance(shape, {}, 96);
}

void write_grids(const std::filesystem::path& file, const openvdb::GridPtrVec& grids) {
    openvdb::io::File(file.string()).write(grids);
}

openvdb::GridPtrVec read_grids(const std::filesystem::path& file) {
    openvdb::io::File reader(file.string());
    reader.open(false);
    return *reader.getGrids();
}

Grid::Ptr sphere_grid(const std::string& name, double voxel = 0.05) {
    openvdb::initialize();
    auto grid = openvdb::tools::createLevelSetSphere<Grid>(1, openvdb::Vec3f(0), static_cast<float>(voxel));
    grid->setName(name);
    return grid;
}

std::string error_of(const std::filesystem::path& file, const std::string& grid = "") {
    try {
        Log log;
        read_level_set(file, grid, log);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

void check_mentions(const std::string& message, const std::vector<std::string>& words) {
    for (const std::string& word : words) {
        CHECK_THAT(message, Catch::Contains(word));
    }
}

} // namespace

TEST_CASE("A baked level set is one to OpenVDB: its class, its band in world units, its signs") {
    const ScratchFolder folder;
    const auto file = folder / "ball.vdb";
    const Transform pose{Vec3(0.3, -2, 1), Vec3(0, 0, 1), 30, 2};
    const auto solid = placed(solid_of({SphereShape{0.5}}), pose);
    const double voxel = 2.0 / 40;
    Progress progress;
    write_level_set(file, *solid, voxel, progress);

    const auto grids = read_grids(file);
    REQUIRE(grids.size() == 1);
    const auto grid = openvdb::gridPtrCast<Grid>(grids[0]);
    REQUIRE(grid);
    CHECK(grid->getName() == "surface");
    CHECK(grid->getGridClass() == openvdb::GRID_LEVEL_SET);
    CHECK(grid->hasUniformVoxels());
    CHECK(grid->voxelSize().x() == Approx(voxel));
    CHECK(grid->background() == Approx(3 * voxel));
    size_t wrong = 0;
    for (auto value = grid->cbeginValueOn(); value; ++value) {
        const openvdb::Vec3d p = grid->indexToWorld(value.getCoord());
        const double truth = glm::length(Vec3(p.x(), p.y(), p.z()) - pose.translate) - 1;
        wrong += !(std::abs(*value - truth) <= 1e-6) ||
                 std::abs(truth) > (3 + 1e-9) * voxel; // float of numbers near 1
    }
    CHECK(wrong == 0);
    // A band of 6 voxels around a sphere of radius 20 has 4 pi (20^2 + 3^2 / 3) 6 of them.
    CHECK(static_cast<double>(grid->activeVoxelCount()) == Approx(30385).epsilon(0.01));
    const auto inside = grid->transform().worldToIndexNodeCentered(openvdb::Vec3d(0.3, -2, 1));
    CHECK(grid->tree().getValue(inside) == Approx(-3 * voxel));
    CHECK(grid->tree().getValue(openvdb::Coord(10000, 0, 0)) == Approx(3 * voxel));
}

TEST_CASE("A solid baked and read again lies within a tenth of a voxel of itself, closed and outwards") {
    const ScratchFolder folder;
    const auto file = folder / "solid.vdb";
    const OccluderShape torus{TorusShape{1, 0.4}};
    const OccluderShape ball_pair{CsgShape{
        CsgOperation::unite,
        {{"", {SphereShape{0.8}}, {}}, {"", {SphereShape{0.8}}, {Vec3(0.5, 0, 0), Vec3(0, 1, 0), 0, 1}}}}};
    for (const OccluderShape& shape : {torus, ball_pair}) {
        const auto solid = solid_of(shape);
        const double voxel = 2.8 / 48;
        Progress progress;
        write_level_set(file, *solid, voxel, progress);
        Log log;
        const Mesh surface = read_level_set(file, "surface", log);
        CHECK(log.warnings.empty());
        const MeshHealth health = examine(surface);
        CHECK(health.boundary_edges == 0);
        CHECK(health.inconsistent_edges.count == 0);
        double volume = 0;
        for (const Triangle& t : surface.triangles) {
            volume += glm::dot(surface.positions[t[0]],
                               glm::cross(surface.positions[t[1]], surface.positions[t[2]])) /
                      6;
        }
        CHECK(volume > 0);
        const auto again = mesh_distance(surface);
        std::mt19937 random(7);
        std::uniform_real_distribution<double> in(-2, 2);
        size_t far = 0;
        for (int i = 0; i < 2000; ++i) {
            const Vec3 p(in(random), in(random), in(random));
            // The crease of the two balls is cut off by up to half a voxel; no point of it is nearest
            // elsewhere.
            const double allowed = &shape == &torus ? 0.1 * voxel : 0.5 * voxel;
            far += !(std::abs(again->at(p).distance - solid->at(p).distance) <= allowed);
        }
        CHECK(far == 0);
    }
}

TEST_CASE("A level set far from the origin, turned and mirrored keeps its place and its orientation") {
    const ScratchFolder folder;
    const auto file = folder / "far.vdb";
    const auto grid = sphere_grid("surface");
    const double mirror = GENERATE(1.0, -1.0);
    const openvdb::Vec3d centre(1e6, -2e5, 3e5);
    openvdb::Mat4d matrix = openvdb::Mat4d::identity();
    matrix.setToRotation(openvdb::Vec3d(1, 2, 3).unit(), 0.7);
    matrix.preScale(openvdb::Vec3d(0.05 * mirror, 0.05, 0.05));
    matrix.postTranslate(centre);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(matrix));
    write_grids(file, {grid});
    Log log;
    const Mesh surface = read_level_set(file, "", log);
    const Vec3 middle(centre.x(), centre.y(), centre.z());
    size_t wrong = 0;
    for (const Triangle& t : surface.triangles) {
        const Vec3 a = surface.positions[t[0]] - middle;
        const Vec3 area =
            glm::cross(surface.positions[t[1]] - middle - a, surface.positions[t[2]] - middle - a);
        wrong += !(std::abs(glm::length(a) - 1) <= 0.1 * 0.05) || !(glm::dot(area, a) > 0);
    }
    CHECK(surface.triangles.size() > 1000);
    CHECK(wrong == 0);
}

TEST_CASE("A .vdb file that holds no level set says what it holds instead") {
    const ScratchFolder folder;
    const auto file = folder / "bad.vdb";
    openvdb::initialize();
    const auto fog = Grid::create(0);
    fog->setName("density");
    fog->setGridClass(openvdb::GRID_FOG_VOLUME);
    fog->tree().setValueOn(openvdb::Coord(0, 0, 0), 1);
    const auto empty = Grid::create(0.15F);
    empty->setName("void");
    empty->setGridClass(openvdb::GRID_LEVEL_SET);
    const auto wind = openvdb::Vec3SGrid::create();
    wind->setName("wind");
    const auto outside = Grid::create(0.15F);
    outside->setName("outside");
    outside->setGridClass(openvdb::GRID_LEVEL_SET);
    outside->fill(openvdb::CoordBBox(openvdb::Coord(0), openvdb::Coord(8)), 0.1F);
    const auto flat = sphere_grid("flat");
    openvdb::Mat4d stretched = openvdb::Mat4d::identity();
    stretched.preScale(openvdb::Vec3d(0.1, 0.2, 0.1));
    flat->setTransform(openvdb::math::Transform::createLinearTransform(stretched));

    write_grids(file, {fog, empty, wind, outside, flat, sphere_grid("a"), sphere_grid("b")});
    check_mentions(error_of(file, "surface"),
                   {"bad.vdb", "surface", "density", "Fog Volume", "void", "wind"});
    check_mentions(error_of(file), {"several level sets", "\"a\"", "\"b\""});
    check_mentions(error_of(file, "density"), {"fog volume", "convert"});
    check_mentions(error_of(file, "void"), {"empty"});
    check_mentions(error_of(file, "wind"), {"one float or double"});
    check_mentions(error_of(file, "outside"), {"no surface"});
    check_mentions(error_of(file, "flat"), {"no cubes", "0.1 x 0.2 x 0.1"});
    CHECK(error_of(file, "a").empty());

    write_grids(file, {fog, wind});
    check_mentions(error_of(file), {"no level set", "density"});
    write_grids(file, {});
    check_mentions(error_of(file), {"no grid"});
    write_file_atomically(file, std::string_view("VDB? no"));
    check_mentions(error_of(file), {"bad.vdb", "no VDB file"});
    check_mentions(error_of(folder / "none.vdb"), {"none.vdb", "No such file"});
}

TEST_CASE("A level set that is cut short anywhere is an error, not a crash") {
    const ScratchFolder folder;
    const auto file = folder / "cut.vdb";
    write_grids(file, {sphere_grid("surface", 0.2)});
    const std::string whole = read_file(file);
    for (size_t part = 0; part < 40; ++part) {
        write_file_atomically(file, std::string_view(whole).substr(0, whole.size() * part / 40));
        CHECK_FALSE(error_of(file).empty());
    }
}

TEST_CASE("What cannot be a level set is refused before it is sampled") {
    const ScratchFolder folder;
    Progress progress;
    const auto ball = solid_of({SphereShape{1}});
    CHECK_THROWS_AS(write_level_set(folder / "x.vdb", *ball, 1e-6, progress), InputError);
    CHECK_THROWS_AS(write_level_set(folder / "x.vdb", *solid_of({PlaneShape{}}), 0.1, progress), InputError);
    const auto far = placed(ball, Transform{Vec3(1e12, 0, 0), Vec3(0, 1, 0), 0, 1});
    CHECK_THROWS_AS(write_level_set(folder / "x.vdb", *far, 0.1, progress), InputError);
    progress.cancel();
    CHECK_THROWS_AS(write_level_set(folder / "x.vdb", *ball, 0.1, progress), Cancelled);
    CHECK(std::filesystem::is_empty(folder.path()));
}

#include "engine/mesh/mesh_writer.h"
#include "engine/mesh/sample_shapes.h"
#include "engine/occluder/field_cache.h"
#include "engine/occluder/occluder_set.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

using namespace anvil;

namespace {

struct Counted final : ExactDistance {
    mutable std::atomic<int> samples{0};

    SignedDistance at(const Vec3& p) const override {
        ++samples;
        const double r = glm::length(p);
        return {r - 1, r > 0 ? p / r : Vec3(0, 1, 0)};
    }
    Box bounds() const override { return {Vec3(-1), Vec3(1)}; }
};

Field field(FieldKind kind) {
    return {kind, 32};
}

} // namespace

TEST_CASE("A field is baked once; then it comes from the cache, bit for bit") {
    const ScratchFolder folder;
    const FileCache files(folder.path(), 1 << 28);
    const auto kind = GENERATE(FieldKind::dense, FieldKind::adaptive);
    const auto solid = std::make_shared<Counted>();
    Progress progress;
    const BakeCache cache{&files, "the sphere"};
    const OccluderModel first = sampled_model(solid, field(kind), progress, cache);
    const int samples = solid->samples;
    REQUIRE(samples > 0);
    const OccluderModel second = sampled_model(solid, field(kind), progress, cache);
    CHECK(solid->samples == samples);
    if (kind == FieldKind::dense) {
        CHECK(packed(*first.volumes.at(0)) == packed(*second.volumes.at(0)));
    } else {
        CHECK(packed(*first.field) == packed(*second.field));
    }
    sampled_model(solid, field(kind), progress, {&files, "another"});
    CHECK(solid->samples > samples);
}

TEST_CASE("A field's description changes with everything that it is baked from, and with nothing else") {
    const ScratchFolder folder;
    const FileCache files(folder / "cache", 1 << 20);
    const SolidSource source{folder.path(), nullptr};
    const auto write = [&](const std::string& name, const char* shape) {
        const Mesh mesh = make_sample(shape, 200);
        write_mesh(folder / name, mesh, mesh.positions);
    };
    write("a.ply", "torus");
    write("b.ply", "torus");
    write("c.ply", "cube");
    const auto of = [&](const OccluderShape& shape, const Field& f = {FieldKind::adaptive, 32}) {
        return bake_cache(&files, shape, f, source).description;
    };
    const auto both = [](const std::string& name, const std::string& file, double at) {
        return OccluderShape{CsgShape{
            CsgOperation::unite,
            {{name, {MeshShape{file}}, {Vec3(at, 0, 0), Vec3(0, 1, 0), 0, 1}}, {"", {SphereShape{1}}, {}}}}};
    };
    CHECK(of({MeshShape{"a.ply"}}) == of({MeshShape{"b.ply"}}));
    CHECK(of({MeshShape{"a.ply"}}) != of({MeshShape{"c.ply"}}));
    CHECK(of(both("x", "a.ply", 1)) == of(both("y", "b.ply", 1)));
    CHECK(of(both("x", "a.ply", 1)) != of(both("x", "c.ply", 1)));
    CHECK(of(both("x", "a.ply", 1)) != of(both("x", "a.ply", 2)));
    CHECK(of({SphereShape{1}}) != of({SphereShape{1.0000001}}));
    CHECK(of({SphereShape{1}}) != of({SphereShape{1}}, {FieldKind::adaptive, 33}));
    CHECK(of({SphereShape{1}}) != of({SphereShape{1}}, {FieldKind::dense, 32}));
    const std::string before = of({MeshShape{"a.ply"}});
    write("a.ply", "cylinder");
    CHECK(of({MeshShape{"a.ply"}}) != before);
    CHECK_THROWS_AS(of({MeshShape{"gone.ply"}}), InputError);
}

TEST_CASE("Bytes that are no field are told from one") {
    Progress progress;
    const std::string dense = packed(bake(Counted(), 16, progress));
    const std::string adaptive = packed(bake_adaptive(Counted(), 16, progress));
    DistanceVolume volume;
    AdaptiveField bricks;
    CHECK(unpack(dense, volume));
    CHECK(unpack(adaptive, bricks));
    CHECK_FALSE(unpack(adaptive, volume));
    CHECK_FALSE(unpack("", volume));
    CHECK_FALSE(unpack("", bricks));
    CHECK_FALSE(unpack(std::string_view(dense).substr(0, dense.size() - 16), volume));
    CHECK_FALSE(unpack(std::string_view(adaptive).substr(0, 40), bricks));
}

#include "engine/core/error.h"
#include "engine/forge/drag_session.h"
#include "engine/mesh/sample_shapes.h"
#include "tests/support/forging.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::test;

namespace {

/// Counts what a session costs, and fails when told to.
class WatchedBackend final : public Backend {
  public:
    std::unique_ptr<DeformSession> prepare(std::shared_ptr<const DeformInput> input) override {
        ++prepared;
        if (broken) {
            throw DeviceError("the device is gone");
        }
        return std::make_unique<Session>(cpu_->prepare(std::move(input)), broken);
    }
    std::string device_name() const override { return "watched"; }
    std::string driver_name() const override { return "watched"; }

    size_t prepared = 0;
    bool broken = false;

  private:
    struct Session final : DeformSession {
        Session(std::unique_ptr<DeformSession> inner, const bool& broken)
            : inner_(std::move(inner)), broken_(broken) {}
        void update(const DeformMotion& motion) override {
            if (broken_) {
                throw DeviceError("the device is gone");
            }
            inner_->update(motion);
        }
        void wait() override { inner_->wait(); }
        std::vector<PointResult> download() override { return inner_->download(); }
        std::vector<Vec3> download_normals() override { return inner_->download_normals(); }
        void refresh_shapes() override { inner_->refresh_shapes(); }
        void refresh_occluders() override { inner_->refresh_occluders(); }
        std::unique_ptr<DeformSession> inner_;
        const bool& broken_;
    };
    std::unique_ptr<Backend> cpu_ = make_cpu_backend();
};

/// A sphere that is dragged at, with its occluders.
struct Bench {
    explicit Bench(Recipe from) : recipe(std::move(from)) {}

    DragSession session() { return {scene, occluders, backend, recipe.edits[0], log}; }

    Recipe recipe;
    Mesh mesh = make_sample("icosphere", 2562);
    RefinementHistory history{mesh};
    KeptSolvers solvers;
    Log log;
    Progress progress;
    WatchedBackend backend;
    DragScene scene{mesh, mesh.positions, history, solvers};
    EditOccluders occluders{recipe, log, progress, nullptr};
};

const char* const pressed =
    "{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': [ {'name': 'ball', 'shape': {'sphere': {'radius': 0.2}}, "
    "'transform': {'translate': [0,1.35,0]}, 'influence': {'kind': 'soft', 'strength': 0.5, 'sigma': 0.1}} "
    "], "
    "'edits': [ {'kind': 'translate', 'handles': [ {'at': {'nearest': [0,1,0]}, 'by': [0,0.3,0.1]}, "
    "{'at': {'nearest': [0.6,0.8,0]}, 'by': [0.1,0.2,0]} ], 'radius': 0.5} ] }";

/// What a session shows is what forge() makes of the edit, but for the finish at the occluder.
void check_like_forge(DragSession& session, Bench& bench) {
    Recipe recipe = bench.recipe;
    recipe.edits = {session.edit()};
    const ForgeResult forged = forged_on_cpu(bench.mesh, recipe);
    const std::vector<Vec3> positions = session.positions();
    REQUIRE(positions.size() == session.region().vertices.size());
    std::vector<Vec3> whole = bench.mesh.positions;
    for (size_t i = 0; i < positions.size(); ++i) {
        whole[session.region().vertices[i]] = positions[i];
    }
    double worst = 0;
    for (size_t v = 0; v < whole.size(); ++v) {
        worst = std::max(worst, glm::length(whole[v] - forged.positions[v]));
    }
    CHECK(worst <= 1e-12);

    const std::vector<Vec3> expected = vertex_normals(bench.mesh, whole);
    const std::vector<Vec3> before = vertex_normals(bench.mesh, bench.mesh.positions);
    const std::vector<Vec3> normals = session.normals();
    REQUIRE(normals.size() == session.normal_vertices().size());
    std::vector<bool> given(whole.size(), false);
    double off = 0;
    for (size_t i = 0; i < normals.size(); ++i) {
        given[session.normal_vertices()[i]] = true;
        off = std::max(off, glm::length(normals[i] - expected[session.normal_vertices()[i]]));
    }
    CHECK(off <= 1e-12);
    for (size_t v = 0; v < whole.size(); ++v) {
        if (!given[v] && glm::length(expected[v] - before[v]) > 1e-12) {
            FAIL("the normal of vertex " << v << " changed, and the session does not give it");
        }
    }
}

} // namespace

TEST_CASE("a drag session shows what forge makes of the edit, with its normals") {
    Bench bench(recipe_of(pressed));
    DragSession session = bench.session();
    check_like_forge(session, bench);
    CHECK(session.normal_vertices().size() > session.region().vertices.size());

    Edit turned = bench.recipe.edits[0];
    turned.kind = EditKind::rotate;
    turned.handles.resize(1);
    turned.handles[0].by.reset();
    turned.handles[0].degrees = 30;
    turned.axis = {Vec3(0), Vec3(1, 0, 0)};
    session.update(turned, bench.occluders);
    check_like_forge(session, bench);
}

TEST_CASE("an update does again only what depends on what has changed") {
    Bench bench(recipe_of(pressed));
    DragSession session = bench.session();
    const DragWork opened = session.work();
    CHECK(opened.distances == 1);
    CHECK(opened.regions == 1);
    Edit edit = bench.recipe.edits[0];

    SECTION("targets, amount and steps cost a step") {
        edit.handles[0].by = Vec3(0.1, 0.2, 0);
        edit.amount = 0.7;
        edit.steps = Steps{false, 64};
        session.update(edit, bench.occluders);
        check_like_forge(session, bench);
        CHECK(bench.backend.prepared == 1);
        CHECK(session.work().updates == 2);
        CHECK(session.work().shapes + session.work().occluders == 0);
        CHECK(session.work().distances == 1);
    }
    SECTION("a shape is handed over alone") {
        edit.shape.preset = "sharp";
        edit.handles[1].shape = ShapeChoice{"linear", {}};
        session.update(edit, bench.occluders);
        check_like_forge(session, bench);
        CHECK(bench.backend.prepared == 1);
        CHECK(session.work().shapes == 1);
        CHECK(session.work().occluders == 0);
    }
    SECTION("an occluder that was moved is handed over alone") {
        bench.recipe.occluders[0].transform.translate.y = 1.25;
        session.update(edit, bench.occluders);
        check_like_forge(session, bench);
        CHECK(bench.backend.prepared == 1);
        CHECK(session.work().occluders == 1);
        CHECK(session.work().shapes == 0);
    }
    SECTION("a smaller radius cuts the region out of the same distances, and the first one comes back") {
        edit.radius = 0.3;
        session.update(edit, bench.occluders);
        check_like_forge(session, bench);
        edit.radius = 0.5;
        session.update(edit, bench.occluders);
        check_like_forge(session, bench);
        CHECK(session.work().distances == 1);
        CHECK(session.work().regions == 3);
    }
    SECTION("a larger radius goes on from the distances that are there, and so do handles that stay") {
        CHECK(session.march_work().begun == 2);
        edit.radius = 0.7;
        session.update(edit, bench.occluders);
        check_like_forge(session, bench);
        CHECK(session.march_work().continued == 2);
        edit.handles.pop_back();
        session.update(edit, bench.occluders);
        check_like_forge(session, bench);
        CHECK(session.march_work().continued == 3);
        edit.radius.reset();
        session.update(edit, bench.occluders);
        check_like_forge(session, bench);
        CHECK(session.march_work().continued == 4);
        CHECK(session.march_work().begun == 2);
        edit.handles.push_back(bench.recipe.edits[0].handles[1]);
        session.update(edit, bench.occluders);
        check_like_forge(session, bench);
        CHECK(session.march_work().continued == 5);
        CHECK(session.march_work().begun == 3);
    }
    SECTION("another method measures anew") {
        edit.method = DistanceMethod::approximate;
        edit.radius = 0.7;
        session.update(edit, bench.occluders);
        check_like_forge(session, bench);
        CHECK(session.march_work().begun == 4);
        CHECK(session.march_work().continued == 0);
    }
}

TEST_CASE("a radius that grows step by step costs the marching of one") {
    for (const DistanceMethod method : {DistanceMethod::approximate, DistanceMethod::exact}) {
        Bench grown(recipe_of(pressed));
        Edit& edit = grown.recipe.edits[0];
        edit.method = method;
        edit.radius = 0.3;
        DragSession session = grown.session();
        for (const double radius : {0.4, 0.5, 0.59}) {
            edit.radius = radius;
            session.update(edit, grown.occluders);
        }
        const size_t before = session.march_work().steps;
        edit.radius = 0.6;
        session.update(edit, grown.occluders);
        check_like_forge(session, grown);

        Bench anew(grown.recipe);
        const DragSession whole = anew.session();
        CHECK(session.march_work().steps <= whole.march_work().steps * 101 / 100);
        CHECK(session.march_work().steps - before <= whole.march_work().steps / 8);
        CHECK(whole.march_work().continued == 0);
    }
}

TEST_CASE("an anchor that is added to others costs what it improves, blended or not") {
    Bench bench(recipe_of(pressed));
    Edit& edit = bench.recipe.edits[0];
    edit.method = DistanceMethod::exact;
    edit.handles.pop_back();
    edit.anchors = {{0, {NearestAddress{Vec3(0.1, 1, 0)}}, std::nullopt}};
    DragSession session = bench.session();
    edit.anchors[0].at.emplace_back(NearestAddress{Vec3(-0.1, 1, 0.1)});
    SECTION("where the nearest one counts its source joins the march") {
        session.update(edit, bench.occluders);
        CHECK(session.march_work().extended == 1);
        CHECK(session.march_work().begun == 1);
    }
    SECTION("where they are blended it gets a field of its own") {
        edit.anchors[0].smooth_width = 0.1;
        session.update(edit, bench.occluders);
        CHECK(session.march_work().continued == 1);
        CHECK(session.march_work().begun == 2);
    }
    check_like_forge(session, bench);
}

TEST_CASE("a target out of reach is refused and the session stays as it was") {
    Bench bench(
        edit_recipe("{'kind': 'translate', 'handles': [ {'at': {'nearest': [0,1,0]}, 'by': [0,0.3,0]} ], "
                    "'radius': 0.5}"));
    DragSession session = bench.session();
    const std::vector<Vec3> before = session.positions();
    Edit edit = bench.recipe.edits[0];
    edit.handles.push_back(edit.handles[0]); // one place cannot go two ways
    edit.handles[1].by = Vec3(0, -0.3, 0);
    CHECK_THROWS_AS(session.update(edit, bench.occluders), InputError);
    CHECK(session.positions() == before);
    CHECK(session.edit() == bench.recipe.edits[0]);
    session.update(session.edit(), bench.occluders);
    CHECK(session.positions() == before);
}

TEST_CASE("when the device fails the drag goes on with the CPU and says so") {
    Bench bench(recipe_of(pressed));
    SECTION("before the first update") {
        bench.backend.broken = true;
    }
    DragSession session = bench.session();
    bench.backend.broken = true;
    Edit edit = bench.recipe.edits[0];
    edit.handles[0].by = Vec3(0.1, 0.2, 0);
    session.update(edit, bench.occluders);
    check_like_forge(session, bench);
    CHECK(session.device_name() == "cpu");
    REQUIRE(bench.log.warnings.size() == 1);
    CHECK(bench.log.warnings[0].find("the device is gone") != std::string::npos);
}

TEST_CASE("a session of a hammer without handles follows the whole mesh") {
    Bench bench(recipe_of("{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': [ {'name': 'ball', 'shape': "
                          "{'sphere': {'radius': 0.3}}} ], "
                          "'edits': [ {'kind': 'translate', 'occluders': [ {'name': 'ball', 'motion': [ "
                          "{'at': 0, 'translate': [0,1.5,0]}, {'at': 1, 'translate': [0,1.1,0]} ]} ]} ] }"));
    DragSession session = bench.session();
    CHECK(session.region().vertices.size() == bench.mesh.vertex_count());
    check_like_forge(session, bench);
    Edit edit = bench.recipe.edits[0];
    edit.amount = 0.5;
    session.update(edit, bench.occluders);
    check_like_forge(session, bench);
    CHECK(session.work().occluders == 1);
}

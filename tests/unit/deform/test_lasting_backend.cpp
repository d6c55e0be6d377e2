#include "engine/deform/lasting_backend.h"
#include "engine/forge/forge.h"
#include "engine/mesh/sample_shapes.h"
#include "tests/support/forging.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::test;

namespace {

/// The float CPU back end as a device, lost at its `calls`-th call.
class LostDevice final : public Backend {
  public:
    explicit LostDevice(int calls) : left_(calls) {}

    std::unique_ptr<DeformSession> prepare(std::shared_ptr<const DeformInput> input) override {
        call();
        return std::make_unique<Session>(*this, inner_->prepare(std::move(input)));
    }
    std::string device_name() const override { return "lost"; }
    std::string driver_name() const override { return "lost"; }
    bool lost() const { return left_ < 0; }

  private:
    struct Session final : DeformSession {
        Session(LostDevice& device, std::unique_ptr<DeformSession> inner)
            : device_(device), inner_(std::move(inner)) {}
        DeformSession& now() {
            device_.call();
            return *inner_;
        }
        void update(const DeformMotion& motion) override { now().update(motion); }
        void wait() override { now().wait(); }
        std::vector<PointResult> download() override { return now().download(); }
        std::vector<Vec3> download_normals() override { return now().download_normals(); }
        void refresh_shapes() override { now().refresh_shapes(); }
        void refresh_occluders() override { now().refresh_occluders(); }
        LostDevice& device_;
        std::unique_ptr<DeformSession> inner_;
    };
    void call() {
        if (--left_ < 0) {
            throw DeviceError("the device was lost");
        }
    }
    std::unique_ptr<Backend> inner_ = make_float_cpu_backend(false);
    int left_;
};

const char* const two_edits =
    "{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': [ {'name': 'ball', 'shape': {'sphere': {'radius': 0.2}}, "
    "'transform': {'translate': [0,1.35,0]}} ], 'edits': [ "
    "{'kind': 'translate', 'handles': [ {'at': {'nearest': [0,1,0]}, 'by': [0,0.3,0.1]} ], 'radius': 0.5}, "
    "{'kind': 'translate', 'handles': [ {'at': {'nearest': [1,0,0]}, 'by': [0.2,0,0]} ], 'radius': 0.5} ] }";

} // namespace

TEST_CASE("forging goes on with the CPU from whichever call the device fails at, and says so once") {
    const Mesh mesh = make_sample("icosphere", 642);
    const Recipe recipe = recipe_of(two_edits);
    const ForgeResult expected = forged_on_cpu(mesh, recipe);
    size_t losses = 0;
    bool lost = true;
    for (int calls = 0; lost; ++calls) {
        REQUIRE(calls < 20);
        Log log;
        Progress progress;
        auto device = std::make_unique<LostDevice>(calls);
        const LostDevice& watched = *device;
        LastingBackend backend(std::move(device), log);
        const ForgeResult result = forge(mesh, recipe, backend, log, progress, nullptr);
        lost = watched.lost();
        losses += lost ? 1 : 0;
        CHECK(result.report.device == (lost ? "cpu" : "lost"));
        REQUIRE(log.warnings.size() == (lost ? 1 : 0));
        if (lost) {
            CHECK(log.warnings[0].find("the device was lost") != std::string::npos);
        }
        REQUIRE(result.positions.size() == expected.positions.size());
        double worst = 0;
        for (size_t v = 0; v < expected.positions.size(); ++v) {
            REQUIRE(is_finite(result.positions[v]));
            worst = std::max(worst, glm::length(result.positions[v] - expected.positions[v]));
        }
        CHECK(worst <= 5e-6 * std::sqrt(12.0)); // an edit before the loss was float's
    }
    CHECK(losses == 8); // prepare, update, wait and download of each edit
}

TEST_CASE("a session goes on from its last motion and from what has been refreshed") {
    const Mesh mesh = make_sample("icosphere", 642);
    auto input = std::make_shared<DeformInput>();
    input->points = mesh.positions;
    input->handle_count = 1;
    input->fields.assign(mesh.positions.size(), 0.25);
    input->segments = {{0, 1, -1, 0, 0}};
    input->shapes = {{0, 1}};
    DeformMotion motion;
    motion.targets = {Vec3(1, 2, 4)};
    Log log;
    LostDevice device(2); // prepare, update
    LastingBackend backend(device, log);
    const auto session = backend.prepare(input);
    CHECK(&computing(*session) != session.get());
    const DeformSession* const on_device = &computing(*session);
    session->update(motion);
    SECTION("read back") {
        CHECK(session->download()[0].displacement == 0.75 * motion.targets[0]);
    }
    SECTION("refreshed") {
        input->segments[0].c1 = -2;
        session->refresh_shapes();
        session->update(motion);
        CHECK(session->download()[0].displacement == 0.5 * motion.targets[0]);
    }
    CHECK(&computing(*session) != on_device);
    CHECK(backend.device_name() == "cpu");
    CHECK(log.warnings.size() == 1);
}

// Parity checks execution; that the formulas are right is for the tests of the reference to show.
#include "engine/core/error.h"
#include "engine/gpu/gpu_backend.h"
#include "engine/gpu/gpu_session.h"
#include "engine/gpu/selftest.h"
#include "tests/gpu/gpu_test.h"

#include <cmath>
#include <future>
#include <random>

using namespace anvil;

namespace {

SelftestCase case_named(const std::string& name) {
    for (SelftestCase& test : selftest_cases()) {
        if (test.name == name) {
            return std::move(test);
        }
    }
    throw std::runtime_error("no case " + name);
}

std::vector<PointResult> run(Backend& backend, const SelftestCase& test) {
    const auto session = backend.prepare(test.input);
    session->update(test.motion);
    return session->download();
}

bool same_bits(const std::vector<PointResult>& a, const std::vector<PointResult>& b) {
    if (a.size() != b.size()) {
        return false;
    }
    for (size_t i = 0; i < a.size(); ++i) {
        if (a[i].displacement != b[i].displacement || a[i].steps != b[i].steps ||
            a[i].samples != b[i].samples || a[i].flags != b[i].flags) {
            return false;
        }
    }
    return true;
}

/// The reference with one result spoiled.
class SpoiledBackend final : public Backend {
  public:
    explicit SpoiledBackend(Vec3 fault) : fault_(fault) {}
    std::unique_ptr<DeformSession> prepare(std::shared_ptr<const DeformInput> input) override {
        return std::make_unique<Session>(cpu_->prepare(std::move(input)), fault_);
    }
    std::string device_name() const override { return "spoiled"; }
    std::string driver_name() const override { return "spoiled"; }

  private:
    struct Session final : DeformSession {
        Session(std::unique_ptr<DeformSession> inner, Vec3 fault) : inner_(std::move(inner)), fault_(fault) {}
        void update(const DeformMotion& motion) override { inner_->update(motion); }
        void wait() override { inner_->wait(); }
        std::vector<PointResult> download() override {
            std::vector<PointResult> results = inner_->download();
            results.at(results.size() / 2).displacement += fault_;
            return results;
        }
        std::vector<Vec3> download_normals() override { return inner_->download_normals(); }
        void refresh_shapes() override { inner_->refresh_shapes(); }
        void refresh_occluders() override { inner_->refresh_occluders(); }
        std::unique_ptr<DeformSession> inner_;
        Vec3 fault_;
    };
    std::unique_ptr<Backend> cpu_ = make_cpu_backend();
    Vec3 fault_;
};

} // namespace

TEST_CASE("the GPU agrees with the double reference on every case of the selftest") {
    const CheckedDevice device;
    const auto backend = make_gpu_backend(device.shared());
    for (const SelftestCase& test : selftest_cases()) {
        const SelftestResult result = run_selftest_case(*backend, test);
        INFO(test.name << ": worst " << result.worst << ", allowed " << result.allowed);
        CHECK(result.points == test.input.points.size());
        CHECK(result.non_finite == 0);
        CHECK(result.deviating == 0);
        CHECK(result.penetrating == 0);
        CHECK(result.passed());
    }
}

TEST_CASE("the selftest sees a point that is off and a point that is not finite") {
    const SelftestCase test = case_named("sphere, soft");
    SpoiledBackend exact(Vec3(0));
    CHECK(run_selftest_case(exact, test).passed());
    SpoiledBackend off(Vec3(2 * 5e-6 * test.lipschitz * test.diagonal, 0, 0));
    CHECK(run_selftest_case(off, test).deviating == 1);
    CHECK_FALSE(run_selftest_case(off, test).passed());
    SpoiledBackend not_finite(Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0));
    CHECK(run_selftest_case(not_finite, test).non_finite == 1);
    CHECK_FALSE(run_selftest_case(not_finite, test).passed());
}

TEST_CASE("points outside every region do not move at all") {
    const CheckedDevice device;
    for (const PointResult& result : run(*make_gpu_backend(device.shared()), case_named("empty region"))) {
        REQUIRE(result.displacement == Vec3(0));
    }
}

TEST_CASE("work split into many chunks gives the same bits") {
    const CheckedDevice device;
    const auto whole = make_gpu_backend(device.shared());
    // 10 kB hold about 360 of the 3001 points.
    const auto split = make_gpu_backend(device.shared(), {.chunk_bytes = 10000});
    for (const char* name : {"blend, 16 handles", "torus, soft", "sampled field"}) {
        const SelftestCase test = case_named(name);
        CHECK(same_bits(run(*whole, test), run(*split, test)));
    }
}

namespace {

/// Where `boxed` and `unboxed` are of one edit with the occluders' boxes known and unknown.
void check_that_boxes_spare_looks_alone(const SelftestCase& test, const std::vector<PointResult>& boxed,
                                        const std::vector<PointResult>& unboxed, size_t& spared) {
    REQUIRE(boxed.size() == unboxed.size());
    for (size_t i = 0; i < boxed.size(); ++i) {
        REQUIRE(std::isfinite(glm::length(boxed[i].displacement)));
        REQUIRE(boxed[i].samples <= unboxed[i].samples);
        const double difference = glm::length(boxed[i].displacement - unboxed[i].displacement);
        if (boxed[i].samples == unboxed[i].samples) {
            REQUIRE(difference == 0); // the same walk
        } else {
            ++spared;
            REQUIRE(boxed[i].samples == 0);
            REQUIRE((unboxed[i].flags & kernel::f64::VERTEX_TOUCHED) == 0);
            // Beyond its reach a soft influence is below exp(-16) of the path, which is at most 1.5 long.
            REQUIRE(difference <= 1.5 * std::exp(-16.0) + 1e-12 * test.diagonal);
        }
    }
}

} // namespace

TEST_CASE("boxes of occluders spare looks at what passes them by, and change nothing") {
    const CheckedDevice device;
    const auto on_device = make_gpu_backend(device.shared());
    const auto on_cpu = make_cpu_backend();
    for (const SelftestCase& test : selftest_cases()) {
        SelftestCase unboxed = test;
        bool bounded =
            !test.input.occluders.empty() && !test.input.occluders.paper && !test.motion.every_step;
        for (kernel::f64::Occluder& occluder : unboxed.input.occluders.occluders) {
            bounded = bounded && occluder.boxed != 0 && std::isfinite(occluder.box_half.x);
            occluder.boxed = 0;
        }
        INFO(test.name);
        // That the device does as the CPU is shown above; a few kernels to compile are enough.
        const bool compiled = test.name == "sphere, hard" || test.name == "path with three samples" ||
                              test.name == "swelling hammer against a turning mesh";
        for (Backend* backend : {on_cpu.get(), compiled ? on_device.get() : on_cpu.get()}) {
            size_t spared = 0;
            check_that_boxes_spare_looks_alone(test, run(*backend, test), run(*backend, unboxed), spared);
            const size_t least = test.name == "empty region" ? 0 : test.input.points.size() / 20;
            CHECK((!bounded || spared >= least));
            CHECK((bounded || spared == 0));
        }
    }
}

namespace {

/// Blending alone: `handles` straight falloffs of distances that differ from point to point.
DeformInput blend_of(size_t points, size_t handles) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(0, 1.1);
    DeformInput input;
    input.points.assign(points, Vec3(0));
    input.handle_count = handles;
    input.segments = {{0, 1, -1, 0, 0}};
    input.shapes.assign(handles, {0, 1});
    input.fields.resize(points * handles);
    std::generate(input.fields.begin(), input.fields.end(), [&] { return any(random); });
    return input;
}

} // namespace

TEST_CASE(
    "blends of more points than a block holds are the sums of weighted targets, for any number of handles") {
    const CheckedDevice device;
    const auto backend = make_gpu_backend(device.shared());
    for (const size_t handles : {1, 3, 10, 16, 17}) {
        const size_t points =
            40'001; // two blocks and a part of a third with 8 handles and fewer, five with 16
        const DeformInput input = blend_of(points, handles);
        DeformMotion motion;
        for (size_t j = 0; j < handles; ++j) {
            motion.targets.emplace_back(1 + 0.1 * static_cast<double>(j), -1, 0.5 * static_cast<double>(j));
        }
        const auto session = backend->prepare(input);
        session->update(motion);
        const std::vector<PointResult> results = session->download();
        REQUIRE(results.size() == points);
        double worst = 0;
        for (size_t i = 0; i < points; ++i) {
            Vec3 sum(0);
            for (size_t j = 0; j < handles; ++j) {
                sum += std::max(0.0, 1 - input.fields[j * points + i]) * motion.targets[j];
            }
            REQUIRE(std::isfinite(glm::length(results[i].displacement)));
            worst = std::max(worst, glm::length(results[i].displacement - sum));
        }
        // Each weight is off by the rounding of its distance and of its own, 2^-24 each, and the targets add
        // up to at most 16 * 10.
        CHECK(worst <= 160 * 2 * std::ldexp(1.0, -24));
    }
}

TEST_CASE("the same update gives the same bits again, whatever came between") {
    const CheckedDevice device;
    const auto backend = make_gpu_backend(device.shared());
    const SelftestCase test = case_named("two occluders");
    const auto session = backend->prepare(test.input);
    session->update(test.motion);
    const auto first = session->download();
    DeformMotion longer = test.motion; // more path samples: the targets' buffer grows
    longer.targets.insert(longer.targets.begin(), test.motion.targets.begin(), test.motion.targets.end());
    session->update(longer);
    session->wait();
    session->update(test.motion);
    session->update(test.motion); // an update need not be waited for
    CHECK(same_bits(first, session->download()));
    CHECK(same_bits(first, session->download()));
}

TEST_CASE("a session outlives its back end") {
    const CheckedDevice device;
    const SelftestCase test = case_named("sphere, hard");
    auto backend = make_gpu_backend(device.shared());
    const auto expected = run(*backend, test);
    const auto session = backend->prepare(test.input);
    backend.reset();
    session->update(test.motion);
    CHECK(same_bits(expected, session->download()));
}

TEST_CASE("a session refuses sizes that do not fit and a result before its first update") {
    const CheckedDevice device;
    const auto backend = make_gpu_backend(device.shared());
    SelftestCase test = case_named("sphere, hard");
    const auto session = backend->prepare(test.input);
    CHECK_THROWS_AS(session->download(), InternalError);
    DeformMotion motion = test.motion;
    motion.targets.pop_back();
    CHECK_THROWS_AS(session->update(motion), InternalError);
    test.input.fields.pop_back();
    CHECK_THROWS_AS(backend->prepare(test.input), InternalError);
}

TEST_CASE("buffers too small for one point are an error, not an endless split") {
    const CheckedDevice device;
    const auto backend = make_gpu_backend(device.shared(), {.chunk_bytes = 100});
    CHECK_THROWS_AS(backend->prepare(case_named("sphere, hard").input), DeviceError);
}

TEST_CASE("the float loops of the CPU pass what a device has to pass") {
    for (const bool widest : {false, true}) {
        const auto backend = make_float_cpu_backend(widest);
        for (const SelftestCase& test : selftest_cases()) {
            const SelftestResult result = run_selftest_case(*backend, test);
            INFO(test.name << ", " << backend->driver_name() << ": worst " << result.worst << ", allowed "
                           << result.allowed << ", " << result.deviating << " deviate");
            CHECK(result.non_finite == 0);
            CHECK(result.penetrating == 0);
            // The rounding of moving poses (sine, exponential) is more than the 4 ulps by which the reference
            // is disturbed to find out where it jumps: one of 3001 points may choose the other occluder.
            CHECK(result.deviating <= (test.input.occluders.moves() ? 1U : 0U));
            CHECK((result.passed() || result.deviating > 0));
        }
    }
}

TEST_CASE("an edit like one that was warmed compiles nothing more, while others are compiled beside it") {
    const CheckedDevice device;
    const auto pipeline = std::make_shared<DeformPipeline>(device.shared());
    const SelftestCase test = case_named("sphere, hard");
    const SelftestCase other = case_named("two occluders");
    DeformInput like;
    like.handle_count = test.input.handle_count;
    like.occluders = test.input.occluders;
    like.shapes = test.input.shapes;
    pipeline->kernel(variant_of(like, test.motion));
    CHECK(pipeline->kernel_count() == 1);
    const auto warming =
        std::async(std::launch::async, [&] { pipeline->kernel(variant_of(other.input, other.motion)); });
    GpuSession session(pipeline, std::make_shared<const DeformInput>(test.input), uint64_t{1} << 20);
    session.update(test.motion);
    warming.wait();
    CHECK(pipeline->kernel_count() == 2);
    const auto expected = run(*make_gpu_backend(device.shared()), test);
    CHECK(same_bits(session.download(), expected));
}

// What a step of a drag takes: no memory, and nothing that is there already is uploaded again.
#include "engine/forge/drag_session.h"
#include "engine/gpu/device_state.h"
#include "engine/gpu/gpu_backend.h"
#include "tests/gpu/gpu_test.h"
#include "tests/support/forging.h"

#include <cstdlib>
#include <new>

using namespace anvil;
using namespace anvil::test;

namespace {

/// What this thread takes from the heap while `counting`.
struct HeapUse {
    bool counting = false;
    size_t bytes = 0;
    size_t largest = 0;
};
thread_local HeapUse heap;

} // namespace

#ifndef __SANITIZE_ADDRESS__ // the sanitizer's own find more; without these nothing is counted
// The program's own, for all of its tests: the standard ones but for the counting. Never inlined: seen
// through, the compiler takes malloc() and free() for a mismatch with the other's new and delete.
[[gnu::noinline]] void* operator new(size_t bytes) {
    if (heap.counting) {
        heap.bytes += bytes;
        heap.largest = std::max(heap.largest, bytes);
    }
    void* const memory = std::malloc(std::max<size_t>(bytes, 1)); // NOLINT
    if (memory == nullptr) {
        throw std::bad_alloc();
    }
    return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory); // NOLINT
}
[[gnu::noinline]] void operator delete(void* memory, size_t) noexcept {
    std::free(memory); // NOLINT
}
#endif

namespace {

/// `entry`: how the edit uses the ball.
Recipe pressed_by(const std::string& entry) {
    return recipe_of(
        "{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': [ {'name': 'ball', 'shape': {'sphere': {'radius': "
        "0.2}}, "
        "'transform': {'translate': [0,1.35,0]}} ], 'edits': [ {'kind': 'translate', 'occluders': [" +
        entry +
        "], 'handles': [ {'at': {'nearest': [0,1,0]}, 'by': [0,0.3,0.1]}, "
        "{'at': {'nearest': [0.6,0.8,0]}, 'by': [0.1,0.2,0]} ], 'radius': 0.7} ] }");
}

struct Taken {
    size_t region = 0;
    uint64_t allocations = 0; ///< of the device's memory
    uint64_t memory = 0;      ///< of it, held more than before
    uint64_t written = 0;     ///< to buffers, bytes
    HeapUse heap;
};

struct Drag {
    Recipe recipe;
    Mesh mesh;
    RefinementHistory history{mesh};
    KeptSolvers solvers;
    Log log;
    Progress progress;
    DragScene scene{mesh, mesh.positions, history, solvers};
    EditOccluders occluders{recipe, log, progress, nullptr};
    std::unique_ptr<DragSession> session;

    Drag(Backend& backend, Recipe of, size_t vertices)
        : recipe(std::move(of)), mesh(make_sample("icosphere", vertices)),
          session(std::make_unique<DragSession>(scene, occluders, backend, recipe.edits[0], log)) {}

    /// One of several like steps, the first of which may find that nothing is ready yet.
    Taken step(const DeviceState* device, const std::function<void(Edit&, double)>& change) {
        Taken taken;
        for (int i = 0; i < 3; ++i) {
            change(recipe.edits[0], 0.01 * i);
            const uint64_t allocations = device ? device->allocations.load() : 0;
            const uint64_t memory = device ? device->memory_in_use.load() : 0;
            const uint64_t written = device ? device->bytes_written.load() : 0;
            heap = {true, 0, 0};
            session->update(recipe.edits[0], occluders);
            heap.counting = false;
            session->wait();
            taken = {session->region().vertices.size(), 0, 0, 0, heap};
            if (device) {
                taken.allocations = device->allocations - allocations;
                taken.memory = device->memory_in_use - memory;
                taken.written = device->bytes_written - written;
            }
        }
        return taken;
    }
};

void drag_handle(Edit& edit, double by) {
    edit.handles[0].by = Vec3(by, 0.3, 0.1);
}

const char* const stands = "'ball'";
const char* const moves = "{'name': 'ball', 'motion': [ {'at': 0, 'translate': [0,1.5,0]}, "
                          "{'at': 0.4, 'translate': [0.1,1.4,0]}, {'at': 1, 'translate': [0,1.3,0]} ]}";

} // namespace

TEST_CASE("a step takes no memory on the device and uploads targets and poses alone, whatever moves") {
    const CheckedDevice device;
    const auto backend = make_gpu_backend(device.shared());
    for (const char* entry : {"", stands, moves}) {
        Drag drag(*backend, pressed_by(entry), 10242);
        const Taken taken = drag.step(&device->state(), drag_handle);
        INFO("occluders: " << entry);
        CHECK(taken.region > 1000);
        CHECK(taken.allocations == 0);
        CHECK(taken.memory == 0);
        CHECK(taken.written > 0);
        CHECK(taken.written <= 4 * (sizeof(glm::vec3) * 2 + sizeof(kernel::f32::Pose))); // at most 4 samples
    }
}

TEST_CASE("an occluder's pose or a shape that changes makes no buffer, and costs the start distances") {
    const CheckedDevice device;
    const auto backend = make_gpu_backend(device.shared());
    Drag posed(*backend, pressed_by(stands), 10242);
    const Taken pose = posed.step(&device->state(), [&posed](Edit& /*edit*/, double by) {
        posed.recipe.occluders[0].transform.translate = Vec3(by, 1.35, 0);
    });
    CHECK(posed.session->work().occluders == 2); // the first step changed nothing
    CHECK(pose.allocations == 0);
    CHECK(pose.written >= pose.region * sizeof(float));
    CHECK(pose.written <= pose.region * sizeof(float) + 1024);

    Drag shaped(*backend, pressed_by(stands), 10242);
    const Taken shape = shaped.step(
        &device->state(), [](Edit& edit, double by) { edit.shape.preset = by > 0.015 ? "smooth" : "sharp"; });
    CHECK(shaped.session->work().shapes == 2);
    CHECK(shape.allocations == 0);
    CHECK(shape.written <= 1024);
}

TEST_CASE("a step takes from the heap what it would take on a smaller mesh, on a device and on the CPU") {
    const CheckedDevice device;
    const auto on_device = make_gpu_backend(device.shared());
    const auto on_cpu = make_cpu_backend();
    for (Backend* backend : {on_device.get(), on_cpu.get()}) {
        for (const char* entry : {"", stands, moves}) {
            const auto taken = [&](size_t vertices) {
                Drag drag(*backend, pressed_by(entry), vertices);
                return drag.step(nullptr, drag_handle);
            };
            const Taken small = taken(2562);
            const Taken large = taken(40962);
            INFO(backend->device_name() << ", occluders: " << entry);
            CHECK(large.region > 3 * small.region);
            // No array over the region, not even of bytes. The validation layer takes a little now and then.
            CHECK(large.heap.largest < large.region);
            CHECK(large.heap.bytes < small.heap.bytes + large.region);
            CHECK(large.heap.bytes < 64 * 1024);
        }
    }
}

#include "engine/forge/drag_session.h"

#include "engine/core/error.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/device_surface.h"
#include "engine/gpu/gpu_backend.h"
#include "tests/gpu/gpu_test.h"
#include "tests/support/forging.h"

using namespace anvil;
using namespace anvil::test;

namespace {

const char* const two_handles =
    "{ 'anvil': 1, 'mesh': 'm.ply', 'occluders': [ {'name': 'ball', 'shape': {'sphere': {'radius': 0.2}}, "
    "'transform': {'translate': [0,1.35,0]}} ], "
    "'edits': [ {'kind': 'translate', 'handles': [ {'at': {'nearest': [0,1,0]}, 'by': [0,0.3,0.1]}, "
    "{'at': {'nearest': [0.6,0.8,0]}, 'by': [0.1,0.2,0]} ], 'radius': 0.7} ] }";

struct Shown {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
};

/// A drag through several targets, shapes, radii and places of the occluder.
std::vector<Shown> shown_by(Backend& backend) {
    Recipe recipe = recipe_of(two_handles);
    const Mesh mesh = make_sample("icosphere", 10242);
    const RefinementHistory history(mesh);
    KeptSolvers solvers;
    Log log;
    Progress progress;
    DragScene scene(mesh, mesh.positions, history, solvers);
    const EditOccluders occluders(recipe, log, progress, nullptr);
    DragSession session(scene, occluders, backend, recipe.edits[0], log);
    std::vector<Shown> shown;
    const auto show = [&](const Edit& edit) {
        session.update(edit, occluders);
        shown.push_back({session.positions(), session.normals()});
    };
    Edit edit = recipe.edits[0];
    show(edit);
    edit.handles[0].by = Vec3(0.1, 0.4, 0);
    show(edit);
    edit.handles[1].path = {Vec3(0), Vec3(0.1, 0, 0), Vec3(0.1, 0.1, 0)};
    edit.handles[1].by.reset();
    show(edit);
    edit.shape.preset = "sharp";
    show(edit);
    recipe.occluders[0].transform.translate = Vec3(0.05, 1.3, 0);
    show(edit);
    edit.radius = 0.6;
    show(edit);
    CHECK(log.warnings.empty());
    CHECK(session.device_name() == backend.device_name());
    return shown;
}

double largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    REQUIRE(a.size() == b.size());
    double worst = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        worst = std::max(worst, glm::length(a[i] - b[i]));
    }
    return worst;
}

} // namespace

TEST_CASE("a drag on the device shows what the CPU shows, normals too, whole and in chunks") {
    const CheckedDevice device;
    const auto expected = shown_by(*make_cpu_backend());
    // 60 kB: a tenth of the region; its fans fill several chunks as well.
    for (const uint64_t bytes : {uint64_t{128} << 20, uint64_t{60000}}) {
        const auto shown = shown_by(*make_gpu_backend(device.shared(), {.chunk_bytes = bytes}));
        REQUIRE(shown.size() == expected.size());
        for (size_t i = 0; i < shown.size(); ++i) {
            CHECK(largest_difference(shown[i].positions, expected[i].positions) <= 5e-6 * std::sqrt(12));
            // Edges are 0.02 long: float's 1e-7 of a place tilts a small triangle by some 1e-5.
            CHECK(largest_difference(shown[i].normals, expected[i].normals) <= 1e-3);
        }
    }
}

namespace {

std::vector<Vec3> copied(DeviceState& device, vk::Buffer from, uint32_t count) {
    std::vector<glm::vec3> values(count);
    const Buffer to(device, values.size() * sizeof(glm::vec3), {}, MemoryUse::download);
    run_commands(device, [&](const vk::raii::CommandBuffer& commands) {
        full_barrier(commands);
        commands.copyBuffer(from, to.handle(), vk::BufferCopy{0, 0, to.size()});
    });
    to.read(0, std::as_writable_bytes(std::span(values)));
    return {values.begin(), values.end()};
}

} // namespace

TEST_CASE("what a drag leaves on the device is what it reads back") {
    const CheckedDevice device;
    const CheckedDevice another;
    const Recipe recipe = recipe_of(two_handles);
    const Mesh mesh = make_sample("icosphere", 2562);
    const RefinementHistory history(mesh);
    KeptSolvers solvers;
    Log log;
    Progress progress;
    DragScene scene(mesh, mesh.positions, history, solvers);
    const EditOccluders occluders(recipe, log, progress, nullptr);
    const auto backend = make_gpu_backend(device.shared());
    DragSession session(scene, occluders, *backend, recipe.edits[0], log);
    const auto surface = device_surface(*session.session(), *device);
    REQUIRE(surface);
    CHECK(surface->point_count == session.region().vertices.size());
    CHECK(surface->normal_count == session.normal_vertices().size());
    CHECK(copied(device->state(), surface->normals, surface->normal_count) == session.normals());
    const std::vector<Vec3> ends = copied(device->state(), surface->ends, surface->point_count);
    const std::vector<Vec3> positions = session.positions();
    for (size_t i = 0; i < ends.size(); ++i) {
        CHECK(glm::length(scene.frame().origin + ends[i] - positions[i]) <= 1e-6);
    }
    CHECK_FALSE(device_surface(*session.session(), *another));
}

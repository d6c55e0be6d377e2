// The drag session: from the click to the first positions, and step by step.
#include "app/bench/workshop.h"
#include "engine/forge/drag_session.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace anvil {

namespace {

struct DragOptions {
    double radius = 0.5; ///< on the unit sphere
    double size = 1;     ///< of the motion and the ball
    size_t handles = 1;
    std::optional<Field> occluder; ///< a ball that the pole is pushed into; absent: none
};

Recipe recipe_of(const Mesh& sphere, const DragOptions& options) {
    Recipe recipe;
    Edit edit;
    edit.radius = options.radius;
    for (size_t j = 0; j < options.handles; ++j) {
        Handle handle;
        handle.at = VertexAddress{static_cast<uint32_t>(j * (sphere.vertex_count() / options.handles))};
        handle.by = 0.3 * options.size * sphere.positions[std::get<VertexAddress>(handle.at).vertex];
        edit.handles.push_back(handle);
    }
    if (options.occluder) {
        const Vec3 away = (1 + 0.4 * options.size) * sphere.positions[0];
        recipe.occluders.push_back({"ball", {SphereShape{0.3 * options.size}}, options.occluder, {away}, {}});
    }
    recipe.edits.push_back(edit);
    return recipe;
}

/// A mesh ready to be dragged at; distances are prepared.
struct DragStage {
    std::shared_ptr<const Mesh> mesh;
    RefinementHistory history;
    KeptSolvers solvers;
    DragScene scene;
    Recipe recipe;
    Log log;
    Progress progress;
    EditOccluders occluders;

    DragStage(std::shared_ptr<const Mesh> of, const DragOptions& options)
        : mesh(std::move(of)), history(*mesh), scene(*mesh, mesh->positions, history, solvers),
          recipe(recipe_of(*mesh, options)), occluders(recipe, log, progress, nullptr) {
        scene.warm();
    }

    /// Until positions and normals are on the device.
    std::unique_ptr<DragSession> opened(Backend& backend) {
        auto session = std::make_unique<DragSession>(scene, occluders, backend, recipe.edits[0], log);
        session->wait();
        return session;
    }
};

/// Two targets in turn.
std::function<void()> steps_of(const std::shared_ptr<DragStage>& stage, Backend& backend) {
    const std::shared_ptr<DragSession> session = stage->opened(backend);
    Edit other = stage->recipe.edits[0];
    other.handles[0].by = 0.9 * *other.handles[0].by;
    return [stage, session, other, first = true]() mutable {
        first = !first;
        session->update(first ? stage->recipe.edits[0] : other, stage->occluders);
        session->wait();
    };
}

/// Places before and after, displacements, distances, what is counted, normals.
uint64_t step_bytes(const DragSession& session) {
    const uint64_t past_occluders =
        session.input().occluders.empty() ? 0 : sizeof(float) + 3 * sizeof(uint32_t);
    const uint64_t of_point =
        3 * sizeof(glm::vec3) + past_occluders + session.input().handle_count * sizeof(float);
    return session.region().vertices.size() * of_point + session.normal_vertices().size() * sizeof(glm::vec3);
}

ReadyCase described(Workshop& workshop, const std::shared_ptr<DragStage>& stage) {
    const auto session = stage->opened(workshop.tested());
    ReadyCase ready;
    ready.vertices = stage->mesh->vertex_count();
    ready.region = session->region().vertices.size();
    ready.bytes = step_bytes(*session);
    return ready;
}

ReadyCase click_case(Workshop& workshop, size_t vertices, const DragOptions& options) {
    const auto stage = std::make_shared<DragStage>(workshop.sphere(vertices), options);
    ReadyCase ready = described(workshop, stage);
    ready.work = [stage, &backend = workshop.tested()] { stage->opened(backend); };
    ready.yardsticks.push_back({"cpu", [stage, &backend = workshop.cpu()] { stage->opened(backend); }});
    ready.yardsticks.push_back(dijkstra_yardstick(*stage->mesh, options.radius));
    return ready;
}

ReadyCase step_case(Workshop& workshop, std::shared_ptr<const Mesh> mesh, const DragOptions& options) {
    const auto stage = std::make_shared<DragStage>(std::move(mesh), options);
    ReadyCase ready = described(workshop, stage);
    ready.work = steps_of(stage, workshop.tested());
    ready.yardsticks.push_back({"cpu", steps_of(stage, workshop.cpu())});
    ready.yardsticks.push_back(memcpy_yardstick(ready.bytes));
    return ready;
}

/// The radius around the first vertex that holds so many; half of it on a mesh four times as fine holds more
/// of them, since an icosphere's are denser at the corners of its icosahedron.
double radius_of(const Mesh& sphere, size_t vertices) {
    std::vector<double> angles;
    angles.reserve(sphere.vertex_count());
    for (const Vec3& p : sphere.positions) {
        angles.push_back(std::acos(std::clamp(glm::dot(p, sphere.positions[0]), -1.0, 1.0)));
    }
    const auto place = angles.begin() + static_cast<std::ptrdiff_t>(vertices - 1);
    std::nth_element(angles.begin(), place, angles.end());
    return *place;
}

/// The same on a mesh of four times as many vertices, half as large: as many vertices in the region, and as
/// much contact.
ReadyCase same_region_case(Workshop& workshop, size_t vertices, const DragOptions& options) {
    const auto small = std::make_shared<DragStage>(workshop.sphere(vertices), options);
    const size_t region = described(workshop, small).region;
    DragOptions half = options;
    half.radius = radius_of(*workshop.sphere(4 * vertices), region);
    half.size = half.radius / options.radius;
    ReadyCase ready = step_case(workshop, workshop.sphere(4 * vertices), half);
    ready.yardsticks.push_back({"quarter_mesh", steps_of(small, workshop.tested())});
    return ready;
}

/// The same mesh with its vertices numbered at random, but for the first.
Mesh shuffled(const Mesh& mesh) {
    std::vector<uint32_t> number(mesh.vertex_count());
    std::iota(number.begin(), number.end(), 0U);
    std::shuffle(number.begin() + 1, number.end(), std::mt19937_64(1));
    Mesh result = mesh;
    for (uint32_t v = 0; v < number.size(); ++v) {
        result.positions[number[v]] = mesh.positions[v];
    }
    for (uint32_t& corner : result.corners) {
        corner = number[corner];
    }
    for (Triangle& triangle : result.triangles) {
        for (uint32_t& corner : triangle) {
            corner = number[corner];
        }
    }
    return result;
}

/// A mesh in random order, beside the same one as it is made.
ReadyCase shuffled_case(Workshop& workshop, size_t vertices, const DragOptions& options) {
    const std::shared_ptr<const Mesh> given = workshop.sphere(vertices);
    ReadyCase ready = step_case(workshop, std::make_shared<const Mesh>(shuffled(*given)), options);
    const auto stage = std::make_shared<DragStage>(given, options);
    ready.yardsticks.push_back({"mesh_in_order", steps_of(stage, workshop.tested())});
    return ready;
}

void add(std::vector<BenchCase>& cases, const std::string& name, std::function<ReadyCase()> prepare) {
    cases.push_back({"drag/" + name, std::move(prepare)});
}

/// Click and steps with and without a ball in the way.
void add_pulls(std::vector<BenchCase>& cases, Workshop& workshop, size_t vertices) {
    for (const bool past_ball : {false, true}) {
        DragOptions options;
        options.occluder = past_ball ? std::optional(Field{}) : std::nullopt;
        const std::string rest = (past_ball ? "/ball/" : "/") + size_text(vertices);
        add(cases, "click" + rest,
            [&workshop, options, vertices] { return click_case(workshop, vertices, options); });
        add(cases, "step" + rest, [&workshop, options, vertices] {
            return step_case(workshop, workshop.sphere(vertices), options);
        });
    }
}

} // namespace

void add_drag_cases(std::vector<BenchCase>& cases, Workshop& workshop, const BenchExtent& extent) {
    constexpr size_t blender = 163'842; // vertices of the mesh that Blender was timed with
    add_pulls(cases, workshop, blender);
    if (extent.quick) {
        return;
    }
    DragOptions options;
    options.occluder = Field{};
    add(cases, "step/shuffled/" + size_text(blender),
        [&workshop, options] { return shuffled_case(workshop, blender, options); });
    for (const size_t vertices : extent.sizes()) {
        add_pulls(cases, workshop, vertices);
    }
    constexpr size_t vertices = 1'000'000;
    options.radius = std::acos(1 - 2 * 0.025); // a fortieth of the sphere
    add(cases, "step/2.5%/1M",
        [&workshop, options] { return step_case(workshop, workshop.sphere(vertices), options); });
    add(cases, "step/same-region/4M",
        [&workshop, options] { return same_region_case(workshop, vertices, options); });
    DragOptions whole{
        .radius = 4, .handles = 4, .occluder = Field{FieldKind::dense, 128}}; // farther than half around
    add(cases, "step/whole/k4/dense/4M",
        [&workshop, whole] { return step_case(workshop, workshop.sphere(4 * vertices), whole); });
}

} // namespace anvil

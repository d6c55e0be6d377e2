// Adaptive refinement by the shape function.
#include "app/bench/workshop.h"
#include "engine/distance/distance.h"
#include "engine/refine/adaptive_refinement.h"

namespace anvil {

namespace {

constexpr double radius = 1; // of influence, on the unit sphere
constexpr size_t most_vertices = 100'000'000;

struct RefineScene {
    std::shared_ptr<const Mesh> mesh;
    RefineState state;
    double tolerance = 0;
    size_t reached = 0;

    RefineScene(std::shared_ptr<const Mesh> of, double tolerance_wanted)
        : mesh(std::move(of)), tolerance(tolerance_wanted) {
        const SurfacePoint source = vertex_point(*mesh, 0);
        const double reach = needed_reach(mesh->triangles, mesh->positions, {&mesh->positions[0], 1}, radius);
        const DistanceField field = GeodesicSolver(*mesh, mesh->positions).solve({&source, 1}, reach);
        reached = field.vertices.size();
        HandleField handle{ShapeFunction(preset_knots("wave")), radius, 0, {}};
        handle.anchors.push_back({field.dense(mesh->vertex_count()), SourceKind::point, std::nullopt});
        state = {mesh->positions, {handle}, {}};
    }

    Refinement refined() const {
        Progress unheard;
        const auto criterion = make_shape_criterion();
        return refine(mesh->triangles, state, *criterion, {tolerance, 0, most_vertices}, unheard);
    }
};

/// Criterion, insertion and the mesh that comes out. The tolerance adds about as many vertices as the region
/// has.
ReadyCase refine_case(const std::shared_ptr<const Mesh>& mesh, double tolerance) {
    const auto scene = std::make_shared<const RefineScene>(mesh, tolerance);
    ReadyCase ready;
    ready.vertices = mesh->vertex_count();
    ready.region = scene->reached;
    ready.bytes = ready.vertices * (sizeof(Vec3) + sizeof(double));
    ready.work = [scene] {
        Refinement refinement = scene->refined();
        divided(*scene->mesh, std::move(refinement.state.parents), refinement.faces);
    };
    ready.yardsticks.push_back(dijkstra_yardstick(*mesh, radius));
    return ready;
}

} // namespace

void add_refine_cases(std::vector<BenchCase>& cases, Workshop& workshop, const BenchExtent& extent) {
    for (const size_t vertices : extent.sizes()) {
        // An edge's error falls with its length squared, which falls with the number of vertices.
        const double tolerance = 200.0 / static_cast<double>(vertices);
        cases.push_back({"refine/shape/" + size_text(vertices), [&workshop, vertices, tolerance] {
                             return refine_case(workshop.sphere(vertices), tolerance);
                         }});
    }
}

} // namespace anvil

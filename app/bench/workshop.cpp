#include "app/bench/workshop.h"

#include "app/bench/lean_dijkstra.h"
#include "engine/core/parallel_for.h"
#include "engine/mesh/sample_shapes.h"

#include <cstring>

namespace anvil {

namespace {

constexpr uint32_t field_resolution = 128;

} // namespace

Workshop::Workshop(Backend& tested, Progress& progress)
    : tested_(tested), progress_(progress), cpu_(make_cpu_backend()), float_cpu_(make_float_cpu_backend()) {}

std::shared_ptr<const Mesh> Workshop::sphere(size_t vertices) {
    if (const auto found = spheres_.find(vertices); found != spheres_.end()) {
        return found->second;
    }
    spheres_.clear(); // the cases come by size
    return spheres_[vertices] = std::make_shared<const Mesh>(make_sample("icosphere", vertices));
}

const OccluderModel& Workshop::obstacle(Obstacle kind) {
    if (const auto found = obstacles_.find(kind); found != obstacles_.end()) {
        return found->second;
    }
    const FieldKind field = kind == Obstacle::analytic ? FieldKind::exact
                            : kind == Obstacle::dense  ? FieldKind::dense
                                                       : FieldKind::adaptive;
    const OccluderShape shape =
        kind == Obstacle::analytic ? OccluderShape{SphereShape{1}} : OccluderShape{TorusShape{0.7, 0.3}};
    return obstacles_.emplace(kind, build_model(shape, {field, field_resolution}, progress_)).first->second;
}

Yardstick dijkstra_yardstick(const Mesh& mesh, double radius) {
    const TriangleGraph graph = make_triangle_graph(
        mesh.triangles, mesh.positions, number_as_given(mesh.triangles.size(), mesh.vertex_count()));
    const auto dijkstra = std::make_shared<LeanDijkstra>(graph);
    return {"dijkstra", [dijkstra, reach = radius / graph.unit] { dijkstra->run(0, reach); }};
}

Yardstick memcpy_yardstick(uint64_t bytes) {
    const auto from = std::make_shared<std::vector<std::byte>>(bytes, std::byte{1});
    const auto to = std::make_shared<std::vector<std::byte>>(bytes, std::byte{2});
    return {"memcpy", [from, to] {
                parallel_for(from->size(), size_t{1} << 18, [&](size_t begin, size_t end) {
                    std::memcpy(to->data() + begin, from->data() + begin, end - begin);
                });
            }};
}

std::string size_text(size_t vertices) {
    return vertices % 1'000'000 == 0 ? std::to_string(vertices / 1'000'000) + "M"
                                     : std::to_string(vertices / 1000) + "k";
}

} // namespace anvil

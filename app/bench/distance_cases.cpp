// Geodesic distances, beside the leanest shortest paths along edges.
#include "app/bench/lean_dijkstra.h"
#include "app/bench/workshop.h"
#include "engine/distance/distance.h"

#include <cmath>

namespace anvil {

namespace {

/// One mesh's solver and yardstick, which several cases share while they are alive.
struct Surface {
    std::shared_ptr<const Mesh> mesh;
    GeodesicSolver solver;
    TriangleGraph graph;
    LeanDijkstra dijkstra;
    SurfacePoint source;

    explicit Surface(std::shared_ptr<const Mesh> of)
        : mesh(std::move(of)), solver(*mesh, mesh->positions),
          graph(make_triangle_graph(mesh->triangles, mesh->positions,
                                    number_as_given(mesh->triangles.size(), mesh->vertex_count()))),
          dijkstra(graph), source(vertex_point(*mesh, 0)) {}

    DistanceField solve(double radius) const {
        return solver.solve({&source, 1}, radius, DistanceMethod::approximate);
    }
};

Yardstick dijkstra_yardstick(const std::shared_ptr<Surface>& surface, double radius) {
    return {"dijkstra", [surface, radius] { surface->dijkstra.run(0, radius / surface->graph.unit); }};
}

/// What a solve leaves: vertex and distance.
constexpr uint64_t bytes_each = sizeof(uint32_t) + sizeof(double);

class DistanceCases {
  public:
    DistanceCases(std::vector<BenchCase>& cases, Workshop& workshop, size_t vertices)
        : cases_(cases), workshop_(workshop), vertices_(vertices) {}

    void prepare() {
        add("prepare", [](const std::shared_ptr<Surface>& surface) {
            ReadyCase ready = of_region(surface, infinity);
            ready.work = [surface] { const GeodesicSolver solver(*surface->mesh, surface->mesh->positions); };
            return ready;
        });
    }

    /// Within the cap that holds this share of a sphere.
    void region(const std::string& name, double share) {
        const double radius = std::acos(1 - 2 * share);
        add(name, [radius](const std::shared_ptr<Surface>& surface) {
            ReadyCase ready = of_region(surface, radius);
            ready.work = [surface, radius] { surface->solve(radius); };
            return ready;
        });
    }

  private:
    static ReadyCase of_region(const std::shared_ptr<Surface>& surface, double radius) {
        ReadyCase ready;
        ready.vertices = surface->mesh->vertex_count();
        ready.region = surface->solve(radius).vertices.size();
        ready.bytes = ready.region * bytes_each;
        ready.yardsticks.push_back(dijkstra_yardstick(surface, radius));
        return ready;
    }

    template <class Make>
    void add(const std::string& name, const Make& make) {
        const auto ready = [&workshop = workshop_, vertices = vertices_, kept = kept_, make] {
            std::shared_ptr<Surface> surface = kept->lock();
            if (!surface) {
                surface = std::make_shared<Surface>(workshop.sphere(vertices));
                *kept = surface;
            }
            return make(surface);
        };
        cases_.push_back({"distance/" + name + "/" + size_text(vertices_), ready});
    }

    std::vector<BenchCase>& cases_;
    Workshop& workshop_;
    size_t vertices_;
    std::shared_ptr<std::weak_ptr<Surface>> kept_ = std::make_shared<std::weak_ptr<Surface>>();
};

} // namespace

void add_distance_cases(std::vector<BenchCase>& cases, Workshop& workshop, const BenchExtent& extent) {
    for (const size_t vertices : extent.sizes()) {
        DistanceCases adder(cases, workshop, vertices);
        adder.prepare();
        adder.region("2.5%", 0.025);
        adder.region("20%", 0.2);
        adder.region("whole", 1);
    }
}

} // namespace anvil

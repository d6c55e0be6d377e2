// Processor time of geodesic distances beside a lean Dijkstra in the same run, and their errors.
//   bench_distance [--sources N] [--no-errors] [MESH or SAMPLE:VERTICES ...]
#include "engine/core/log.h"
#include "engine/distance/distance.h"
#include "engine/mesh/mesh_reader.h"
#include "engine/mesh/sample_shapes.h"
#include "app/bench/lean_dijkstra.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

using namespace anvil;

namespace {

/// Processor time of this process: other work on the machine disturbs it least.
double seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Spread {
    std::vector<double> samples;
    double median() {
        std::sort(samples.begin(), samples.end());
        return samples[samples.size() / 2];
    }
    double least() const { return *std::min_element(samples.begin(), samples.end()); }
};

template <typename Work>
double timed(const Work& work) {
    const double start = seconds();
    work();
    return seconds() - start;
}

Mesh mesh_named(const std::string& name) {
    const size_t colon = name.rfind(':');
    if (colon != std::string::npos) {
        return make_sample(name.substr(0, colon), std::strtoul(name.c_str() + colon + 1, nullptr, 10));
    }
    Log log;
    return read_mesh(name, log);
}

std::vector<SurfacePoint> at_vertex(uint32_t v) {
    return {{no_index, Vec3(0.0), v}};
}

/// Radius around the source that holds some `count` vertices.
double radius_of(const GeodesicSolver& solver, uint32_t source, size_t count) {
    std::vector<double> distances =
        solver.solve(at_vertex(source), infinity, DistanceMethod::approximate).distances;
    std::sort(distances.begin(), distances.end());
    return count < distances.size() ? distances[count] : infinity;
}

struct Case {
    const GeodesicSolver& solver;
    LeanDijkstra& lean;
    double unit;
    std::vector<uint32_t> sources;
};

void compare(const Case& c, const char* label, size_t count) {
    Spread fronts, windows, dijkstra;
    size_t vertices = 0, exact_vertices = 0;
    for (const uint32_t source : c.sources) {
        const double radius = count == 0 ? infinity : radius_of(c.solver, source, count);
        const int repeats = count == 0 ? 5 : 15;
        Spread own, other, precise;
        for (int i = 0; i < repeats; ++i) {
            own.samples.push_back(timed([&] {
                vertices =
                    c.solver.solve(at_vertex(source), radius, DistanceMethod::approximate).vertices.size();
            }));
            other.samples.push_back(timed([&] { c.lean.run(source, radius / c.unit); }));
        }
        for (int i = 0; i < 3 && (count != 0 || vertices < 60000); ++i) {
            precise.samples.push_back(timed([&] {
                exact_vertices =
                    c.solver.solve(at_vertex(source), radius, DistanceMethod::exact).vertices.size();
            }));
        }
        fronts.samples.push_back(own.median());
        dijkstra.samples.push_back(other.median());
        if (!precise.samples.empty()) {
            windows.samples.push_back(precise.median() / static_cast<double>(exact_vertices));
        }
    }
    const double ratio = fronts.median() / dijkstra.median();
    std::printf(
        "  %-6s %8zu vertices: approximate %9.3f ms (%.3f us/vertex), lean Dijkstra %9.3f ms, ratio %.2f",
        label, vertices, 1e3 * fronts.median(), 1e6 * fronts.median() / static_cast<double>(vertices),
        1e3 * dijkstra.median(), ratio);
    if (!windows.samples.empty()) {
        std::printf(", exact %.2f us/vertex", 1e6 * windows.median());
    }
    std::printf("\n");
}

void errors(const Case& c, const TriangleGraph& graph, double mean_edge) {
    double sum = 0, worst = 0;
    size_t count = 0, above = 0;
    for (const uint32_t source : c.sources) {
        const std::vector<double> truth =
            c.solver.solve(at_vertex(source), infinity, DistanceMethod::exact).dense(graph.vertex_count());
        const std::vector<double> found =
            c.solver.solve(at_vertex(source), infinity, DistanceMethod::approximate)
                .dense(graph.vertex_count());
        for (size_t v = 0; v < truth.size(); ++v) {
            if (std::isfinite(truth[v]) && truth[v] > mean_edge) {
                const double error = std::abs(found[v] - truth[v]) / truth[v];
                sum += error;
                worst = std::max(worst, error);
                above += error > 0.01 ? 1 : 0;
                ++count;
            }
        }
    }
    std::printf("  error  mean %.4f %%, max %.3f %%, above 1 %%: %zu of %zu\n",
                100 * sum / static_cast<double>(count), 100 * worst, above, count);
}

void bench(const std::string& name, size_t source_count, bool with_errors) {
    Mesh mesh;
    const double read = timed([&] { mesh = mesh_named(name); });
    // The yardstick runs on the mesh as it came.
    const TriangleGraph graph = make_triangle_graph(
        mesh.triangles, mesh.positions, number_as_given(mesh.triangles.size(), mesh.vertex_count()));
    Spread prepare;
    for (int i = 0; i < 3; ++i) {
        prepare.samples.push_back(timed([&] { const GeodesicSolver solver(mesh, mesh.positions); }));
    }
    const GeodesicSolver solver(mesh, mesh.positions);
    LeanDijkstra lean(graph);
    Case c{solver, lean, graph.unit, {}};
    for (size_t i = 0; i < source_count; ++i) {
        c.sources.push_back(graph.corner_vertex[(i * graph.corner_vertex.size()) / source_count]);
    }
    std::printf("%s: %zu vertices, got in %.1f ms, prepared in %.1f ms (%.2f us/vertex)\n", name.c_str(),
                mesh.vertex_count(), 1e3 * read, 1e3 * prepare.least(),
                1e6 * prepare.least() / static_cast<double>(mesh.vertex_count()));
    compare(c, "2k", 2000);
    compare(c, "34k", 34000);
    compare(c, "full", 0);
    if (with_errors) {
        double sum = 0;
        for (uint32_t side = 0; side < graph.corner_vertex.size(); ++side) {
            sum += graph.length(side);
        }
        errors(c, graph, sum * graph.unit / static_cast<double>(graph.corner_vertex.size()));
    }
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
    std::vector<std::string> names;
    size_t sources = 3;
    bool with_errors = true;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        if (argument == "--no-errors") {
            with_errors = false;
        } else if (argument == "--sources" && i + 1 < argc) {
            sources = std::strtoul(argv[++i], nullptr, 10);
        } else {
            names.push_back(argument);
        }
    }
    if (names.empty()) {
        names = {"sphere:10000", "torus:20000", "hand:40000", "bust:40000"};
    }
    try {
        for (const std::string& name : names) {
            bench(name, sources, with_errors);
        }
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "bench_distance: %s\n", problem.what());
        return 2;
    }
    return 0;
}

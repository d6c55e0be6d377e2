// Processor time of geodesic distances beside a lean Dijkstra in the same run, and their errors.
//   bench_distance [--sources N] [--no-errors] [MESH ...]
// MESH is a file or SAMPLE:VERTICES; ~N behind it: subdivided N times by Loop's rule. Preparation is held
// against loading the same mesh from binary PLY, by processor time and by the clock on the wall, since it
// runs on all cores; handles in parallel against one after the other, and memory is that of the process. Of
// meshes beyond 60000 vertices the exact method runs on regions alone.
#include "app/bench/lean_dijkstra.h"
#include "engine/core/log.h"
#include "engine/core/parallel_for.h"
#include "engine/core/scratch_folder.h"
#include "engine/distance/distance.h"
#include "engine/mesh/mesh_reader.h"
#include "engine/mesh/mesh_writer.h"
#include "engine/mesh/sample_shapes.h"
#include "tests/bench/loop_subdivision.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <malloc.h> // malloc_trim
#include <string>
#include <thread>
#include <unistd.h> // sysconf

using namespace anvil;

namespace {

constexpr size_t most_exact = 60000; // vertices

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

double wall_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Bytes of this process that are in memory and in use; 0 where the system does not say.
double resident() {
    ::malloc_trim(0);
    std::ifstream in("/proc/self/statm");
    double all = 0, pages = 0;
    in >> all >> pages;
    return pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

template <typename Work>
double timed(const Work& work) {
    const double start = seconds();
    work();
    return seconds() - start;
}

Mesh mesh_named(const std::string& name) {
    const size_t times = name.rfind('~');
    if (times != std::string::npos) {
        Mesh mesh = mesh_named(name.substr(0, times));
        for (unsigned long i = 0; i < std::strtoul(name.c_str() + times + 1, nullptr, 10); ++i) {
            mesh = loop_subdivided(mesh);
        }
        return mesh;
    }
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
        for (int i = 0; i < 3 && (count != 0 || vertices < most_exact); ++i) {
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

/// Least of several times, of all processors and on the wall.
struct BothTimes {
    double work = infinity, wall = infinity;
};

template <typename Work>
BothTimes least_times(int times, const Work& work) {
    BothTimes least;
    for (int i = 0; i < times; ++i) {
        const double start = wall_seconds();
        least.work = std::min(least.work, timed(work));
        least.wall = std::min(least.wall, wall_seconds() - start);
    }
    return least;
}

/// Preparation beside loading the same mesh from binary PLY.
void preparation(const std::string& name, const Mesh& mesh) {
    const ScratchFolder folder;
    write_mesh(folder / "mesh.ply", mesh, mesh.positions);
    const BothTimes load = least_times(9, [&] {
        Log log;
        read_mesh(folder / "mesh.ply", log);
    });
    const BothTimes prepare = least_times(9, [&] { const GeodesicSolver solver(mesh, mesh.positions); });
    std::printf(
        "%s: %zu vertices, from PLY in %.1f ms, prepared in %.1f ms (%.2f us/vertex, %.2f of loading); "
        "on the wall %.1f and %.1f ms (%.2f)\n",
        name.c_str(), mesh.vertex_count(), 1e3 * load.work, 1e3 * prepare.work,
        1e6 * prepare.work / static_cast<double>(mesh.vertex_count()), prepare.work / load.work,
        1e3 * load.wall, 1e3 * prepare.wall, prepare.wall / load.wall);
}

/// Bytes a vertex of the tables, and of what a run over everything adds, by either method.
void memory(const Mesh& mesh) {
    const auto vertices = static_cast<double>(mesh.vertex_count());
    const double before = resident();
    const GeodesicSolver solver(mesh, mesh.positions);
    const double prepared = resident();
    solver.solve(at_vertex(0), infinity, DistanceMethod::approximate);
    const double approximate = resident();
    solver.solve(at_vertex(0), 0, DistanceMethod::exact);
    std::printf(
        "  memory tables %.0f bytes a vertex, approximate workspace +%.0f, exact tables and workspace "
        "+%.0f\n",
        (prepared - before) / vertices, (approximate - prepared) / vertices,
        (resident() - approximate) / vertices);
}

/// Regions of 2000 vertices around many handles, in turn and on all cores.
void many_handles(const Case& c, const Mesh& mesh) {
    constexpr size_t handles = 64;
    std::vector<uint32_t> vertices;
    for (size_t i = 0; i < handles; ++i) {
        vertices.push_back(mesh.triangles[i * mesh.triangles.size() / handles][0]);
    }
    const double radius = radius_of(c.solver, c.sources.front(), 2000);
    const auto solve = [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            c.solver.solve(at_vertex(vertices[i]), radius, DistanceMethod::approximate);
        }
    };
    Spread in_turn, together, work;
    for (int i = 0; i < 9; ++i) {
        const double start = wall_seconds(), start_work = seconds();
        solve(0, handles);
        const double middle = wall_seconds(), middle_work = seconds();
        parallel_for(handles, 1, solve);
        in_turn.samples.push_back(middle - start);
        together.samples.push_back(wall_seconds() - middle);
        work.samples.push_back((seconds() - middle_work) / (middle_work - start_work));
    }
    std::printf(
        "  %zu handles of 2k: in turn %.1f ms, together %.1f ms, gain %.2f on %u threads (wall); %.2f of the "
        "processor time\n",
        handles, 1e3 * in_turn.least(), 1e3 * together.least(), in_turn.least() / together.least(),
        std::thread::hardware_concurrency(), work.median());
}

/// A radius that grows in 20 steps from a region of half of `count` vertices to one of `count`: going on from
/// step to step, and anew at every step.
void growing_radius(const Case& c, DistanceMethod method, const char* name, size_t count) {
    constexpr int steps = 20;
    const uint32_t source = c.sources.front();
    const double first = radius_of(c.solver, source, count / 2), last = radius_of(c.solver, source, count);
    if (!std::isfinite(last)) {
        return;
    }
    Spread continued, anew;
    for (int repeat = 0; repeat < 5; ++repeat) {
        GeodesicMarch march = c.solver.march(method);
        march.add({at_vertex(source), {}, {}});
        march.grow(first);
        double gone_on = 0, begun = 0;
        for (int i = 1; i <= steps; ++i) {
            const double radius = first + (last - first) * i / steps;
            gone_on += timed([&] {
                march.grow(radius);
                march.field();
            });
            begun += timed([&] { c.solver.solve(at_vertex(source), radius, method); });
        }
        continued.samples.push_back(gone_on / steps);
        anew.samples.push_back(begun / steps);
    }
    std::printf("  radius grown to %zu vertices in %d steps, %s: a step gone on with %.3f ms, anew %.3f ms\n",
                count, steps, name, 1e3 * continued.median(), 1e3 * anew.median());
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
    const Mesh mesh = mesh_named(name);
    // The yardstick runs on the mesh as it came.
    const TriangleGraph graph = make_triangle_graph(
        mesh.triangles, mesh.positions, number_as_given(mesh.triangles.size(), mesh.vertex_count()));
    const GeodesicSolver solver(mesh, mesh.positions);
    LeanDijkstra lean(graph);
    Case c{solver, lean, graph.unit, {}};
    for (size_t i = 0; i < source_count; ++i) {
        c.sources.push_back(graph.corner_vertex[(i * graph.corner_vertex.size()) / source_count]);
    }
    preparation(name, mesh);
    memory(mesh);
    compare(c, "2k", 2000);
    compare(c, "34k", 34000);
    compare(c, "full", 0);
    many_handles(c, mesh);
    growing_radius(c, DistanceMethod::approximate, "approximate", 30000);
    growing_radius(c, DistanceMethod::exact, "exact", 4000);
    if (with_errors && mesh.vertex_count() < most_exact) {
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
        names = {"sphere:10000", "torus:20000", "hand:40000", "bust:40000", "bust:43000~2"};
        if (const char* exact = std::getenv("ANVIL_TEST_EXACT")) {
            names.push_back(std::string(exact) + "/armadillo.obj");
            names.push_back(std::string(exact) + "/nefertiti.obj");
            names.push_back(std::string(exact) + "/armadillo.obj~2");
        }
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

// Processor seconds (all threads together) that adaptive refinement takes: inserting alone, and all of it;
// and how far the distances of new vertices are off.
//   bench_refine [SAMPLE:VERTICES or a mesh file] [TOLERANCE ...]
#include "engine/core/log.h"
#include "engine/distance/distance.h"
#include "engine/mesh/mesh_reader.h"
#include "engine/mesh/sample_shapes.h"
#include "engine/refine/adaptive_refinement.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numeric>
#include <string>

using namespace anvil;

namespace {

constexpr int repeats = 5;

double median(std::vector<double> samples) {
    std::sort(samples.begin(), samples.end());
    return samples[samples.size() / 2];
}

/// Of this process: other work on the machine disturbs it least.
template <typename Work>
double seconds(const Work& work) {
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

RefineState state_of(const Mesh& mesh, uint32_t vertex, const std::string& preset, double radius,
                     DistanceMethod method = DistanceMethod::automatic) {
    HandleField handle{ShapeFunction(preset_knots(preset)), radius, 0, {}};
    const Vec3 place = mesh.positions[vertex];
    const double reach = needed_reach(mesh.triangles, mesh.positions, {&place, 1}, radius);
    const SurfacePoint source = vertex_point(mesh, vertex);
    const DistanceField field = GeodesicSolver(mesh, mesh.positions).solve({&source, 1}, reach, method);
    handle.anchors.push_back({field.dense(mesh.vertex_count()), SourceKind::point, std::nullopt});
    return {mesh.positions, {handle}, {}};
}

/// Every edge split in its middle, with distances and attributes, no errors measured.
void insert_everywhere(const Mesh& mesh, const RefineState& start) {
    std::vector<uint32_t> all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    std::vector<double> numbering, inserting, dividing;
    size_t inserted = 0;
    for (int i = 0; i < repeats; ++i) {
        RefineState state = start;
        std::optional<EdgeMesh> net;
        numbering.push_back(seconds([&] { net.emplace(mesh.triangles, all, mesh.vertex_count()); }));
        inserting.push_back(seconds([&] {
            const auto edges = static_cast<uint32_t>(net->edges().size());
            for (uint32_t e = 0; e < edges; ++e) {
                const EdgeMesh::Edge edge = net->edges()[e];
                net->mark(e, state.add_vertex({edge.a, edge.b, 0.5}));
            }
            net->split(all, [](uint32_t, uint32_t, uint32_t, uint32_t) { return true; });
        }));
        inserted = state.parents.size();
        dividing.push_back(seconds([&] { divided(mesh, state.parents, net->faces()); }));
    }
    const double time = median(inserting);
    std::printf(
        "  every edge split: %zu vertices, numbering %.3f s, inserting %.3f s (%.2f M/s), mesh %.3f s; "
        "all together %.2f M/s\n",
        inserted, median(numbering), time, static_cast<double>(inserted) / time / 1e6, median(dividing),
        static_cast<double>(inserted) / (time + median(numbering) + median(dividing)) / 1e6);
}

/// How far the distances and weights that new vertices got from their edges are from those of a march over
/// the refined mesh, both exact: the price of no new marching, and of a crease that stays where it was put.
void compare_with_fresh(const Mesh& mesh, uint32_t vertex, const std::string& preset, double radius,
                        double tolerance) {
    RefineState start = state_of(mesh, vertex, preset, radius, DistanceMethod::exact);
    Progress progress;
    const auto criterion = make_shape_criterion();
    const Refinement result =
        refine(mesh.triangles, std::move(start), *criterion, {tolerance, 0, 2'000'000}, progress);
    const RefinedMesh refined = divided(mesh, result.state.parents, result.faces);
    const SurfacePoint source = vertex_point(refined.mesh, vertex);
    const std::vector<double> fresh = GeodesicSolver(refined.mesh, refined.mesh.positions)
                                          .solve({&source, 1}, 1.5 * radius, DistanceMethod::exact)
                                          .dense(refined.mesh.vertex_count());
    const HandleField& handle = result.state.handles[0];
    double most = 0, sum = 0, most_weight = 0;
    size_t count = 0, beyond = 0;
    for (size_t v = mesh.vertex_count(); v < fresh.size(); ++v) {
        const double kept = handle.distance(static_cast<uint32_t>(v));
        if (kept > radius || !std::isfinite(fresh[v])) {
            continue;
        }
        const double weight = std::abs(handle.shape(kept / radius) - handle.shape(fresh[v] / radius));
        most = std::max(most, std::abs(kept - fresh[v]) / radius);
        most_weight = std::max(most_weight, weight);
        sum += std::abs(kept - fresh[v]) / radius;
        beyond += weight > tolerance ? 1 : 0;
        ++count;
    }
    std::printf(
        "  %s, tolerance %g: %zu new vertices within R; distances off fresh ones by %.2g R on average, "
        "%.2g R at most; weights by %.2g at most, %zu by more than the tolerance\n",
        preset.c_str(), tolerance, count, sum / static_cast<double>(std::max<size_t>(1, count)), most,
        most_weight, beyond);
}

void refine_by_shape(const Mesh& mesh, const RefineState& start, double tolerance) {
    std::vector<double> refining, dividing;
    RefineReport report;
    for (int i = 0; i < repeats; ++i) {
        RefineState state = start;
        Refinement result;
        Progress progress;
        const auto criterion = make_shape_criterion();
        refining.push_back(seconds([&] {
            result =
                refine(mesh.triangles, std::move(state), *criterion, {tolerance, 0, 100'000'000}, progress);
        }));
        report = result.report;
        dividing.push_back(seconds([&] { divided(mesh, result.state.parents, result.faces); }));
    }
    std::printf(
        "  tolerance %g: %zu vertices in %zu rounds, largest error %.3g, refining %.3f s, mesh %.3f s\n",
        tolerance, report.added, report.rounds, report.max_error, median(refining), median(dividing));
}

Mesh mesh_named(const std::string& name) {
    const size_t colon = name.find(':');
    if (colon == std::string::npos) {
        Log log;
        return read_mesh(name, log);
    }
    return make_sample(name.substr(0, colon), std::strtoul(name.c_str() + colon + 1, nullptr, 10));
}

} // namespace

int main(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "hand:511000";
    const Mesh mesh = mesh_named(name);
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    std::printf("%s: %zu vertices; medians of %d\n", name.c_str(), mesh.vertex_count(), repeats);
    const double radius = 0.3 * bounds(mesh).diagonal();
    const RefineState start = state_of(mesh, static_cast<uint32_t>(mesh.vertex_count() / 2), "wave", radius);
    insert_everywhere(mesh, start);
    std::vector<double> tolerances;
    for (int i = 2; i < argc; ++i) {
        tolerances.push_back(std::strtod(argv[i], nullptr));
    }
    for (const double tolerance : tolerances.empty() ? std::vector<double>{1e-3, 1e-5, 3e-6} : tolerances) {
        refine_by_shape(mesh, start, tolerance);
    }
    for (const char* preset : {"smooth", "plateau"}) {
        compare_with_fresh(mesh, static_cast<uint32_t>(mesh.vertex_count() / 2), preset, radius, 0.001);
    }
    return 0;
}

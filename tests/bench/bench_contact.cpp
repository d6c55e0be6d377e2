// The promise of contact at scale: every mesh of a folder as an occluder, baked dense and adaptive with 64,
// 128 and 256 voxels, a sphere pushed at it by one and by five of its sizes, and what ends inside, judged
// without any of the engine's own distances or signs: winding numbers summed over all triangles, and
// distances to all triangles of what these call inside. Usage:
//   bench_contact FOLDER [VERTICES [ANGLES]]
// prints one line a run and exits with 1 if a vertex that started outside ended deeper inside than 1e-6 of
// the size. ANGLES: the most point-triangle angles of one run (default 2e8); those nearest to the surface are
// judged first, and the line says how many were.
#include "engine/core/parallel_for.h"
#include "engine/deform/backend.h"
#include "engine/deform/contact_finish.h"
#include "tests/bench/bench_mesh.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <numeric>

using namespace anvil;
using namespace anvil::bench;

namespace {

double segment_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
    const double squared = glm::dot(b - a, b - a);
    const double t = squared > 0 ? std::clamp(glm::dot(p - a, b - a) / squared, 0.0, 1.0) : 0;
    return glm::length(p - a - t * (b - a));
}

/// By the plane where the foot is within the triangle, else by the sides.
double triangle_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 n = glm::cross(b - a, c - a);
    const bool within = glm::dot(glm::cross(b - a, p - a), n) >= 0 &&
                        glm::dot(glm::cross(c - b, p - b), n) >= 0 &&
                        glm::dot(glm::cross(a - c, p - c), n) >= 0 && glm::length(n) > 0;
    return within
               ? std::abs(glm::dot(p - a, n)) / glm::length(n)
               : std::min({segment_distance(p, a, b), segment_distance(p, b, c), segment_distance(p, c, a)});
}

double surface_distance(const Mesh& mesh, const Vec3& p) {
    double least = infinity;
    for (const Triangle& t : mesh.triangles) {
        least = std::min(
            least, triangle_distance(p, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]));
    }
    return least;
}

struct Verdict {
    size_t judged = 0;
    size_t inside = 0; ///< deeper than 1e-6 of the size
    double deepest = 0;
};

Verdict judge(const Mesh& mesh, double size, std::vector<Vec3> ends, const OccluderSet& set, double angles) {
    std::vector<std::pair<double, Vec3>> order;
    for (const Vec3& p : ends) {
        order.emplace_back(std::abs(exact_distance(set, p).distance), p);
    }
    std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    Verdict verdict;
    verdict.judged =
        std::min(order.size(), static_cast<size_t>(angles / static_cast<double>(mesh.triangles.size())));
    std::mutex mutex;
    parallel_for(verdict.judged, 16, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) {
            if (std::abs(winding(mesh, order[i].second)) < 0.5) {
                continue;
            }
            const double depth = surface_distance(mesh, order[i].second);
            const std::lock_guard lock(mutex);
            verdict.deepest = std::max(verdict.deepest, depth);
            verdict.inside += depth > 1e-6 * size ? 1 : 0;
        }
    });
    return verdict;
}

/// Of 100 points a thousandth of the size beneath the surface, on whichever side winding numbers call inside:
/// how many the judge finds. A judge that finds none says nothing.
size_t seen_by_judge(const Mesh& mesh, double size) {
    size_t seen = 0;
    for (size_t i = 0; i < 100; ++i) {
        const Triangle& t = mesh.triangles[i * mesh.triangles.size() / 100];
        const Vec3& a = mesh.positions[t[0]];
        const Vec3 n = glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
        const Vec3 centre = (a + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
        for (const double side : {-1e-3, 1e-3}) {
            const Vec3 p = centre + side * size * n / std::max(glm::length(n), 1e-300);
            if (std::abs(winding(mesh, p)) >= 0.5 && surface_distance(mesh, p) > 1e-6 * size) {
                ++seen;
                break;
            }
        }
    }
    return seen;
}

struct Run {
    std::string name;
    const Mesh& mesh;
    const OccluderModel& model;
    FieldKind kind;
    uint32_t resolution;
    double reach;
};

bool holds(const Run& run, size_t vertices, double angles) {
    const Box box = bounds(run.mesh);
    const double size = box.diagonal();
    const Vec3 way = glm::normalize(Vec3(1, 0.3, 0.2));
    const Mesh ball = make_sample("sphere", vertices);
    OccluderSet set;
    add_occluder(set, run.model, run.name, {}, {InfluenceKind::hard, 0.9, {}, {}, 0}, {Vec3(0), size, size});

    DeformInput input;
    for (const Vec3& p : ball.positions) {
        input.points.push_back(box.centre() - 0.85 * size * way + 0.3 * size * p);
    }
    input.handle_count = 1;
    input.fields.assign(input.points.size(), 0.5);
    input.segments = {{0, 1, 0, 0, 0}};
    input.shapes = {{0, 1}};
    input.occluders = set;
    find_start_distances(input);
    DeformMotion motion;
    motion.targets = {run.reach * size * way};

    const auto start = std::chrono::steady_clock::now();
    const auto session = make_cpu_backend()->prepare(input);
    session->update(motion);
    const auto results = session->download();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::vector<Vec3> ends = input.points;
    std::vector<bool> inside(ends.size(), false);
    size_t limited = 0;
    for (size_t i = 0; i < ends.size(); ++i) {
        ends[i] += results[i].displacement;
        inside[i] = (results[i].flags & kernel::f64::VERTEX_STARTED_INSIDE) != 0;
        limited += (results[i].flags & kernel::f64::VERTEX_LIMIT_REACHED) != 0 ? 1 : 0;
    }
    const size_t finished = finish_contact(set, input.points, inside, ends);
    std::vector<Vec3> outside;
    for (size_t i = 0; i < ends.size(); ++i) {
        if (!inside[i]) {
            outside.push_back(ends[i]);
        }
    }
    const Verdict verdict = judge(run.mesh, size, outside, set, angles);
    std::printf(
        "%-26s %-8s %4u voxels, %g sizes: %zu inside (deepest %.1e of the size; %zu of %zu judged), %zu "
        "finished on "
        "the CPU, %zu at the step limit, %.2f s\n",
        run.name.c_str(), run.kind == FieldKind::dense ? "dense" : "adaptive", run.resolution, run.reach,
        verdict.inside, verdict.deepest / size, verdict.judged, outside.size(), finished, limited, seconds);
    std::fflush(stdout);
    return verdict.inside == 0;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: bench_contact FOLDER [VERTICES [ANGLES]]\n");
        return 2;
    }
    const size_t vertices = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 20000;
    const double angles = argc > 3 ? std::strtod(argv[3], nullptr) : 2e8;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
        const auto extension = entry.path().extension();
        if (extension == ".obj" || extension == ".ply" || extension == ".off" || extension == ".stl") {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    bool all = true;
    for (const auto& file : files) {
        Log log;
        const Mesh mesh = read_mesh(file, log);
        const size_t seen = seen_by_judge(mesh, bounds(mesh).diagonal());
        std::printf("%-26s the judge finds %zu of 100 points beneath the surface\n", file.filename().c_str(),
                    seen);
        all = all && seen > 50;
        for (const uint32_t resolution : {64U, 128U, 256U}) {
            for (const FieldKind kind : {FieldKind::adaptive, FieldKind::dense}) {
                Progress progress;
                const OccluderModel model =
                    build_model({MeshShape{file.filename().string()}}, {kind, resolution}, progress,
                                {file.parent_path(), nullptr});
                for (const double reach : {1.0, 5.0}) {
                    all = holds({file.filename().string(), mesh, model, kind, resolution, reach}, vertices,
                                angles) &&
                          all;
                }
            }
        }
    }
    return all ? 0 : 1;
}

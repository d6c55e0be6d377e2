// Baked distance fields of meshes, dense and adaptive: processor seconds to bake beside those of OpenVDB's
// meshToVolume, memory, time per step of the deformation, errors at random points, and how far the results of
// an edit differ.
// Dense fields are also held against a dense one on a grid moved by half a voxel: how far results hang on
// where the samples happen to lie.
//   bench_occluder [--no-dense] [--bake-only] [--no-compare] [--influence soft|hard] [--device]
//                  [--points N] [--pushed N] [--resolution N ...] MESH or SAMPLE:VERTICES ...
// --no-compare: without OpenVDB. --device: edits on the Vulkan device in place of the CPU in double.
#include "engine/deform/backend.h"
#include "tests/bench/baked_field.h"
#include "tests/bench/bench_backend.h"
#include "tests/bench/bench_mesh.h"

#include <cstdio>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <random>

using namespace anvil;
using namespace anvil::bench;

namespace {

struct Options {
    bool dense = true;
    bool bake_only = false;
    bool compare = true;
    bool device = false;
    InfluenceKind influence = InfluenceKind::soft;
    size_t points = 1000000;
    size_t pushed = 100000;
    std::vector<uint32_t> resolutions;
    std::vector<std::string> meshes;
};

/// Points around the solid, all pushed through it by half its diagonal.
DeformInput pushed_points(const OccluderSet& set, const Box& box, size_t count) {
    std::mt19937_64 random(8);
    DeformInput input;
    for (size_t i = 0; i < count; ++i) {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) {
            p[axis] = std::uniform_real_distribution<double>(box.low[axis], box.high[axis])(random);
        }
        input.points.push_back(p);
    }
    input.handle_count = 1;
    input.fields.assign(input.points.size(), 0.0);
    input.segments = {{0, 1, -1, 0, 0}};
    input.shapes = {{0, 1}};
    input.occluders = set;
    find_start_distances(input);
    return input;
}

struct Pushed {
    double nanoseconds = 0; ///< processor time per evaluation of the field, least of several
    std::vector<PointResult> results;
};

Pushed pushed(Backend& backend, const OccluderSet& set, const Box& box, size_t count) {
    const DeformInput input = pushed_points(set, box, count);
    DeformMotion motion;
    motion.targets = {0.5 * (box.high - box.low)};
    const auto session = backend.prepare(input);
    session->update(motion); // compiles
    session->wait();
    double best = infinity;
    for (int round = 0; round < 5; ++round) {
        const double start = seconds();
        session->update(motion);
        session->wait();
        best = std::min(best, seconds() - start);
    }
    Pushed result;
    result.results = session->download();
    double samples = 0;
    for (const PointResult& r : result.results) {
        samples += r.samples;
    }
    result.nanoseconds = 1e9 * best / samples;
    return result;
}

/// How far each result moves at most when its point is moved by `reach` along an axis: much where it could
/// pass the solid on either side, whatever the field.
std::vector<double> unsteadiness(Backend& backend, const OccluderSet& set, const Box& box, double reach,
                                 const std::vector<PointResult>& results) {
    std::vector<double> most(results.size(), 0.0);
    DeformMotion motion;
    motion.targets = {0.5 * (box.high - box.low)};
    for (int direction = 0; direction < 6; ++direction) {
        DeformInput input = pushed_points(set, box, results.size());
        for (Vec3& p : input.points) {
            p[direction / 2] += direction % 2 == 0 ? reach : -reach;
        }
        find_start_distances(input);
        const auto session = backend.prepare(input);
        session->update(motion);
        const std::vector<PointResult> moved = session->download();
        for (size_t i = 0; i < most.size(); ++i) {
            most[i] = std::max(most[i], glm::length(moved[i].displacement - results[i].displacement));
        }
    }
    return most;
}

/// Of what starts outside, and how much of it differs by more than the tolerance and what moving by that much
/// does to it.
void print_difference(const char* what, const Pushed& a, const Pushed& b, const std::vector<double>& unsteady,
                      double voxel) {
    std::vector<double> differences;
    size_t beyond = 0;
    for (size_t i = 0; i < a.results.size(); ++i) {
        if ((a.results[i].flags & kernel::f64::VERTEX_STARTED_INSIDE) != 0) {
            continue;
        }
        const double d = glm::length(a.results[i].displacement - b.results[i].displacement) / voxel;
        differences.push_back(d);
        beyond += d > adaptive_tolerance(0) + unsteady[i] / voxel ? 1 : 0;
    }
    std::sort(differences.begin(), differences.end());
    const size_t n = differences.size();
    std::printf(
        "    dense results against those of %s, voxels: median %.4f, 90 %% %.4f, 99 %% %.3f, worst %.2f; "
        "farther apart than the tolerance and what it does to the dense ones: %.3f %%; time per "
        "evaluation %.2f x dense\n",
        what, differences[n / 2], differences[n * 9 / 10], differences[n * 99 / 100], differences[n - 1],
        100.0 * static_cast<double>(beyond) / static_cast<double>(n), b.nanoseconds / a.nanoseconds);
}

/// Processor seconds of OpenVDB for a narrow band of 3 voxels on each side, from the mesh's arrays on.
double seconds_of_openvdb(const Mesh& mesh, double voxel) {
    const double start = seconds();
    std::vector<openvdb::Vec3s> points;
    for (const Vec3& p : mesh.positions) {
        points.emplace_back(p.x / voxel, p.y / voxel, p.z / voxel);
    }
    std::vector<openvdb::Vec3I> triangles;
    for (const Triangle& t : mesh.triangles) {
        triangles.emplace_back(t[0], t[1], t[2]);
    }
    const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> adapter(points,
                                                                                             triangles);
    const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
    const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(adapter, *transform, 3, 3);
    return grid->activeVoxelCount() > 0 ? seconds() - start : infinity;
}

/// Both from the mesh's arrays on, in turns; medians.
void compare_bakes(const std::string& name, uint32_t resolution) {
    const Mesh mesh = mesh_named(name);
    constexpr size_t rounds = 5;
    std::array<double, rounds> ours{};
    std::array<double, rounds> theirs{};
    std::array<double, rounds> ratios{};
    for (size_t round = 0; round < rounds; ++round) {
        const double start = seconds();
        const std::shared_ptr<const ExactDistance> exact = mesh_distance(mesh);
        const Baked field = baked(exact, FieldKind::adaptive, resolution, InfluenceKind::hard);
        ours[round] = seconds() - start;
        theirs[round] = seconds_of_openvdb(mesh, field.voxel);
        ratios[round] = ours[round] / theirs[round];
    }
    for (auto* times : {&ours, &theirs, &ratios}) {
        std::sort(times->begin(), times->end());
    }
    std::printf(
        "%s: %zu triangles, %u voxels, adaptive bake with all preparation %.2f s, OpenVDB's meshToVolume "
        "%.2f s (processor time, medians of %zu), ratio %.2f (%.2f to %.2f)\n",
        name.c_str(), mesh.triangles.size(), resolution, ours[rounds / 2], theirs[rounds / 2], rounds,
        ratios[rounds / 2], ratios.front(), ratios.back());
    std::fflush(stdout);
}

void print_field(const char* kind, const Baked& field, const Baked* dense, const ExactDistance& exact,
                 size_t points) {
    const auto percent = [](size_t some, size_t all) {
        return 100.0 * static_cast<double>(some) / static_cast<double>(all);
    };
    const Errors all = errors_of(field, dense, random_samples(exact, field.voxel, points, infinity));
    const size_t near = points / 10;
    const Errors band = errors_of(field, dense, random_samples(exact, field.voxel, near, 3 * field.voxel));
    std::printf("  %-8s bake %7.2f s  %7.2f MB  settle %.3f  band rms %.4f worst %.2f sign %.4f %% normal "
                "%.3f | all: rms %.3f worst %.2f beyond %.4f %% (and beyond the dense one: %.4f %%) normal "
                "%.3f\n",
                kind, field.seconds, field.megabytes, field.error / field.voxel, band.rms, band.worst,
                percent(band.wrong_sign, near), band.normal_rms, all.rms, all.worst,
                percent(all.beyond, points), percent(all.worse, points), all.normal_rms);
}

void measure(const std::string& name, uint32_t resolution, const Options& options) {
    const Mesh mesh = mesh_named(name);
    const double start = seconds();
    const std::shared_ptr<const ExactDistance> exact = mesh_distance(mesh);
    const double prepared = seconds() - start;
    std::printf("%s: %zu triangles, %u voxels, prepared in %.2f s\n", name.c_str(), mesh.triangles.size(),
                resolution, prepared);
    const auto backend = bench_backend(options.device);
    const auto push = [&](const Baked& f) {
        return pushed(*backend, f.set, exact->bounds(), options.pushed);
    };
    Baked dense;
    Pushed reference;
    std::vector<double> unsteady;
    if (options.dense) {
        dense = baked(exact, FieldKind::dense, resolution, options.influence);
        reference = push(dense);
        print_field("dense", dense, nullptr, *exact, options.points);
        unsteady = unsteadiness(*backend, dense.set, exact->bounds(), adaptive_tolerance(0) * dense.voxel,
                                reference.results);
    }
    const Baked field = baked(exact, FieldKind::adaptive, resolution, options.influence);
    print_field("adaptive", field, options.dense ? &dense : nullptr, *exact, options.points);
    const Pushed results = push(field);
    std::printf("    %s, %s influence: %.1f ns an evaluation\n", backend->device_name().c_str(),
                options.influence == InfluenceKind::soft ? "soft" : "hard", results.nanoseconds);
    if (options.dense) {
        print_difference("the adaptive field", reference, results, unsteady, field.voxel);
        const Vec3 by(0.5 * field.voxel);
        const Baked moved = baked(std::make_shared<MovedSolid>(exact, by), FieldKind::dense, resolution,
                                  options.influence, by);
        print_difference("a dense field half a voxel beside", reference, push(moved), unsteady, field.voxel);
    }
    std::fflush(stdout);
}

Options parse(int count, char** arguments) {
    Options options;
    for (int i = 1; i < count; ++i) {
        const std::string word = arguments[i];
        if (word == "--no-dense") {
            options.dense = false;
        } else if (word == "--bake-only") {
            options.bake_only = true;
        } else if (word == "--no-compare") {
            options.compare = false;
        } else if (word == "--device") {
            options.device = true;
        } else if (word == "--influence" && i + 1 < count) {
            options.influence =
                std::string(arguments[++i]) == "hard" ? InfluenceKind::hard : InfluenceKind::soft;
        } else if (word == "--pushed" && i + 1 < count) {
            options.pushed = std::strtoul(arguments[++i], nullptr, 10);
        } else if (word == "--points" && i + 1 < count) {
            options.points = std::strtoul(arguments[++i], nullptr, 10);
        } else if (word == "--resolution" && i + 1 < count) {
            options.resolutions.push_back(static_cast<uint32_t>(std::strtoul(arguments[++i], nullptr, 10)));
        } else {
            options.meshes.push_back(word);
        }
    }
    if (options.resolutions.empty()) {
        options.resolutions = {64, 128};
    }
    if (options.meshes.empty()) {
        options.meshes = {"bust:50000"};
    }
    return options;
}

} // namespace

int main(int count, char** arguments) {
    const Options options = parse(count, arguments);
    openvdb::initialize();
    for (const std::string& mesh : options.meshes) {
        for (const uint32_t resolution : options.resolutions) {
            if (options.compare) {
                compare_bakes(mesh, resolution);
            }
            if (!options.bake_only) {
                measure(mesh, resolution, options);
            }
        }
    }
}

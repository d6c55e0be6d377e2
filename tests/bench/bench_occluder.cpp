// Baked distance fields of meshes, dense and adaptive: processor seconds to bake beside those of OpenVDB's
// meshToVolume, memory, time per step of the deformation, errors at random points, and how far the results of
// an edit differ.
//   bench_occluder [--no-dense] [--bake-only] [--points N] [--resolution N ...] MESH or SAMPLE:VERTICES ...
#include "engine/core/parallel_for.h"
#include "engine/deform/backend.h"
#include "engine/occluder/mesh_distance.h"
#include "engine/occluder/occluder_kernel.h"
#include "engine/occluder/occluder_set.h"
#include "tests/bench/bench_mesh.h"

#include <cstdio>
#include <ctime>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <random>

using namespace anvil;
using namespace anvil::bench;

namespace {

/// Processor time of this process, all threads: other work on the machine disturbs it least.
double seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Options {
    bool dense = true;
    bool bake_only = false;
    size_t points = 1000000;
    std::vector<uint32_t> resolutions;
    std::vector<std::string> meshes;
};

/// A field as the kernels see it.
struct Baked {
    OccluderSet set;
    double voxel = 0;
    double error = 0;
    double seconds = 0;
    double megabytes = 0;
};

Baked baked(const std::shared_ptr<const ExactDistance>& exact, FieldKind kind, uint32_t resolution,
            InfluenceKind influence) {
    Progress progress;
    const double start = seconds();
    const OccluderModel model = sampled_model(exact, {kind, resolution}, progress);
    Baked result;
    result.seconds = seconds() - start;
    result.voxel = model.field ? model.field->voxel : model.volumes.front()->voxel;
    result.error = model.field ? model.field->error : model.volumes.front()->error;
    result.megabytes =
        static_cast<double>(model.field ? model.field->bytes()
                                        : model.volumes.front()->texels.size() * sizeof(float)) /
        1e6;
    const double diagonal = exact->bounds().diagonal();
    add_occluder(result.set, model, "tool", {}, {influence, 0.9, {}, {}, 0},
                 {Vec3(0), diagonal, 0.5 * diagonal});
    return result;
}

struct Sample {
    Vec3 point;
    SignedDistance truth;
};

/// Anywhere in the field's box, as far as it reaches beyond the solid's; no farther from the surface than
/// `band`.
std::vector<Sample> random_samples(const ExactDistance& exact, double voxel, size_t count, double band) {
    const Box box = exact.bounds();
    const Vec3 margin(3 * voxel);
    std::mt19937_64 random(7);
    std::vector<Sample> samples;
    while (samples.size() < count) {
        std::vector<Sample> more(100000);
        for (Sample& s : more) {
            for (int i = 0; i < 3; ++i) {
                s.point[i] = std::uniform_real_distribution<double>(box.low[i] - margin[i],
                                                                    box.high[i] + margin[i])(random);
            }
        }
        parallel_for(more.size(), 256, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                more[i].truth = exact.at(more[i].point);
            }
        });
        std::erase_if(more, [&](const Sample& s) { return !(std::abs(s.truth.distance) <= band); });
        samples.insert(samples.end(), more.begin(), more.end());
    }
    samples.resize(count);
    return samples;
}

struct Errors {
    double rms = 0;
    double worst = 0;
    size_t beyond = 0;     ///< more than adaptive_tolerance()
    size_t wrong_sign = 0; ///< where |distance| > voxel / 4
    double normal_rms = 0; ///< length of the difference
};

Errors errors_of(const Baked& field, const std::vector<Sample>& samples) {
    kernel::f64::OccluderKernel kernel{field.set.segments.data(), field.set.nodes.data(),
                                       field.set.occluders.data(), field.set.volumes.data(),
                                       field.set.words()};
    Errors errors;
    for (const Sample& s : samples) {
        const auto probe = kernel.occluder_probe(0, s.point);
        const double error = std::abs(probe.distance - s.truth.distance) / field.voxel;
        errors.rms += error * error;
        errors.worst = std::max(errors.worst, error);
        errors.beyond += error > adaptive_tolerance(s.truth.distance / field.voxel) ? 1 : 0;
        const bool counts = std::abs(s.truth.distance) > 0.25 * field.voxel;
        errors.wrong_sign += counts && (probe.distance < 0) != (s.truth.distance < 0) ? 1 : 0;
        errors.normal_rms += std::pow(glm::length(probe.normal - s.truth.normal), 2);
    }
    errors.rms = std::sqrt(errors.rms / static_cast<double>(samples.size()));
    errors.normal_rms = std::sqrt(errors.normal_rms / static_cast<double>(samples.size()));
    return errors;
}

/// Points around the solid, all pushed through it by half its diagonal.
DeformInput pushed_points(const OccluderSet& set, const Box& box) {
    std::mt19937_64 random(8);
    DeformInput input;
    for (size_t i = 0; i < 100000; ++i) {
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

Pushed pushed(Backend& backend, const OccluderSet& set, const Box& box) {
    const DeformInput input = pushed_points(set, box);
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
        DeformInput input = pushed_points(set, box);
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
void print_difference(const Pushed& a, const Pushed& b, const std::vector<double>& unsteady, double voxel) {
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
        "    dense against adaptive results, voxels: median %.4f, 90 %% %.4f, 99 %% %.3f, worst %.2f; "
        "farther apart than the tolerance and what it does to the dense ones: %.3f %%; time per "
        "evaluation %.2f x dense\n",
        differences[n / 2], differences[n * 9 / 10], differences[n * 99 / 100], differences[n - 1],
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

void measure(const std::string& name, uint32_t resolution, const Options& options) {
    const Mesh mesh = mesh_named(name);
    const double start = seconds();
    const std::shared_ptr<const ExactDistance> exact = mesh_distance(mesh);
    const double prepared = seconds() - start;
    std::printf("%s: %zu triangles, %u voxels, prepared in %.2f s\n", name.c_str(), mesh.triangles.size(),
                resolution, prepared);
    const auto backend = make_cpu_backend();
    std::vector<Pushed> results;
    std::vector<double> unsteady;
    double voxel = 0;
    for (const FieldKind kind : {FieldKind::dense, FieldKind::adaptive}) {
        if (kind == FieldKind::dense && !options.dense) {
            continue;
        }
        const Baked field = baked(exact, kind, resolution, InfluenceKind::soft);
        voxel = field.voxel;
        const Errors all = errors_of(field, random_samples(*exact, voxel, options.points, infinity));
        const Errors band = errors_of(field, random_samples(*exact, voxel, options.points / 10, 3 * voxel));
        results.push_back(pushed(*backend, field.set, exact->bounds()));
        if (kind == FieldKind::dense) {
            unsteady = unsteadiness(*backend, field.set, exact->bounds(), adaptive_tolerance(0) * voxel,
                                    results.back().results);
        }
        std::printf(
            "  %-8s bake %7.2f s  %7.2f MB  settle %.3f  band rms %.4f worst %.2f sign %.4f %% normal %.3f | "
            "all: rms %.3f worst %.2f beyond %.4f %%  normal %.3f | %s %.1f ns\n",
            kind == FieldKind::dense ? "dense" : "adaptive", field.seconds, field.megabytes,
            field.error / voxel, band.rms, band.worst,
            100.0 * static_cast<double>(band.wrong_sign) / static_cast<double>(options.points / 10),
            band.normal_rms, all.rms, all.worst,
            100.0 * static_cast<double>(all.beyond) / static_cast<double>(options.points), all.normal_rms,
            backend->device_name().c_str(), results.back().nanoseconds);
    }
    if (results.size() == 2) {
        print_difference(results[0], results[1], unsteady, voxel);
    }
}

Options parse(int count, char** arguments) {
    Options options;
    for (int i = 1; i < count; ++i) {
        const std::string word = arguments[i];
        if (word == "--no-dense") {
            options.dense = false;
        } else if (word == "--bake-only") {
            options.bake_only = true;
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
            compare_bakes(mesh, resolution);
            if (!options.bake_only) {
                measure(mesh, resolution, options);
            }
        }
    }
}

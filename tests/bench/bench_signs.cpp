// Which points are inside, on damaged copies of sound meshes: all faces inverted, one in twenty flipped,
// every face twice, a hole, a shifted copy through it. The truth is the sound mesh's sign, itself held
// against winding numbers summed over all triangles. Points lie within three voxels of the surface and not
// within a quarter of one. Usage:
//   bench_signs [--points N] [--resolution N] MESH or SAMPLE:VERTICES ...
#include "engine/core/parallel_for.h"
#include "engine/occluder/distance_volume.h"
#include "engine/occluder/mesh_distance.h"
#include "tests/bench/bench_mesh.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <functional>
#include <random>

using namespace anvil;
using namespace anvil::bench;

namespace {

struct Samples {
    std::vector<Vec3> points;
    std::vector<SignedDistance> found;
};

std::vector<SignedDistance> traced(const ExactDistance& exact, const std::vector<Vec3>& points) {
    std::vector<SignedDistance> found(points.size());
    parallel_for(points.size(), 512, [&](size_t i, size_t end) {
        exact.tracer()->trace({&points[i], end - i}, {&found[i], end - i});
    });
    return found;
}

/// Points beside faces picked at random.
Samples near_surface(const Mesh& mesh, const ExactDistance& exact, double voxel, size_t count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> beside(-3 * voxel, 3 * voxel);
    Samples samples;
    while (samples.points.size() < count) {
        std::vector<Vec3> points(count);
        for (Vec3& p : points) {
            const Triangle& t = mesh.triangles[random() % mesh.triangles.size()];
            const Vec3 centre = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
            p = centre + Vec3(beside(random), beside(random), beside(random));
        }
        const std::vector<SignedDistance> found = traced(exact, points);
        for (size_t i = 0; i < points.size() && samples.points.size() < count; ++i) {
            const double distance = std::abs(found[i].distance);
            if (distance > 0.25 * voxel && distance < 3 * voxel) {
                samples.points.push_back(points[i]);
                samples.found.push_back(found[i]);
            }
        }
    }
    return samples;
}

/// How many of the first points the sound mesh's sign and the sum over its triangles call different sides.
size_t doubtful(const Mesh& mesh, const Samples& samples, size_t count) {
    std::atomic<size_t> different = 0;
    parallel_for(std::min(count, samples.points.size()), 8, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const bool inside = std::abs(winding(mesh, samples.points[i])) > 0.5;
            different += inside != (samples.found[i].distance < 0) ? 1 : 0;
        }
    });
    return different;
}

/// What was done to a mesh, and which points and signs it is held against.
struct Damage {
    const char* name;
    Mesh mesh;
    std::function<bool(size_t point, const SignedDistance& found)> counts;
    std::function<bool(size_t point)> inside;
};

void report(const Damage& damage, const Samples& samples) {
    const auto exact = mesh_distance(damage.mesh);
    const std::vector<SignedDistance> found = traced(*exact, samples.points);
    size_t wrong = 0;
    size_t all = 0;
    for (size_t i = 0; i < found.size(); ++i) {
        if (damage.counts(i, found[i])) {
            ++all;
            wrong += (found[i].distance < 0) != damage.inside(i) ? 1 : 0;
        }
    }
    std::printf("  %-48s %6zu of %zu wrong: %.4f %%\n", damage.name, wrong, all,
                100.0 * static_cast<double>(wrong) / static_cast<double>(all));
    std::fflush(stdout);
}

void flip(Triangle& t) {
    std::swap(t[1], t[2]);
}

Mesh flipped(Mesh mesh, unsigned one_in) {
    std::mt19937 random(4);
    for (Triangle& t : mesh.triangles) {
        if (random() % one_in == 0) {
            flip(t);
        }
    }
    return mesh;
}

Mesh with_copy(const Mesh& mesh, const Vec3& shift) {
    Mesh both = mesh;
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const Vec3& p : mesh.positions) {
        both.positions.push_back(p + shift);
    }
    for (const Triangle& t : mesh.triangles) {
        both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return both;
}

Mesh with_hole(Mesh mesh, const Vec3& centre, double radius) {
    std::erase_if(mesh.triangles,
                  [&](const Triangle& t) { return glm::length(mesh.positions[t[0]] - centre) < radius; });
    return mesh;
}

void measure(const std::string& name, uint32_t resolution, size_t count) {
    const Mesh mesh = mesh_named(name);
    const auto exact = mesh_distance(mesh);
    const double voxel = voxel_grid(exact->bounds(), resolution).voxel;
    const Samples samples = near_surface(mesh, *exact, voxel, count);
    constexpr size_t checked = 1000;
    std::printf("%s: %zu triangles; of %zu points %zu where the sum over all triangles says otherwise\n",
                name.c_str(), mesh.triangles.size(), std::min(checked, count),
                doubtful(mesh, samples, checked));
    const auto always = [](size_t, const SignedDistance&) { return true; };
    const auto inside = [&](size_t i) { return samples.found[i].distance < 0; };
    report({"all faces inverted", flipped(mesh, 1), always, inside}, samples);
    report({"one face in twenty flipped", flipped(mesh, 20), always, inside}, samples);
    report({"every face twice", with_copy(mesh, Vec3(0)), always, inside}, samples);

    const Vec3 hole = mesh.positions[mesh.triangles[mesh.triangles.size() / 3][0]];
    const double radius = 4 * voxel;
    const Mesh open = with_hole(mesh, hole, radius);
    const auto away = [&](size_t i, const SignedDistance&) {
        return glm::length(samples.points[i] - hole) > 2 * radius;
    };
    report({"a hole 8 voxels wide, 4 voxels and more from it", open, away, inside}, samples);
    report({"the same everywhere, as if it were closed", open, always, inside}, samples);

    const Vec3 shift = 0.3 * voxel * Vec3(1) + 0.15 * (exact->bounds().high - exact->bounds().low);
    const auto clear = [&](size_t, const SignedDistance& d) { return std::abs(d.distance) > 0.25 * voxel; };
    const auto in_either = [&](size_t i) {
        return inside(i) || exact->at(samples.points[i] - shift).distance < 0;
    };
    report({"a shifted copy through it", with_copy(mesh, shift), clear, in_either}, samples);
}

} // namespace

int main(int count, char** arguments) {
    uint32_t resolution = 128;
    size_t points = 30000;
    std::vector<std::string> meshes;
    for (int i = 1; i < count; ++i) {
        const std::string word = arguments[i];
        if (word == "--points" && i + 1 < count) {
            points = std::strtoull(arguments[++i], nullptr, 10);
        } else if (word == "--resolution" && i + 1 < count) {
            resolution = static_cast<uint32_t>(std::strtoul(arguments[++i], nullptr, 10));
        } else {
            meshes.push_back(word);
        }
    }
    if (meshes.empty()) {
        meshes = {"bust:50000"};
    }
    for (const std::string& mesh : meshes) {
        measure(mesh, resolution, points);
    }
}

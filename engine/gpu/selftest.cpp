#include "engine/gpu/selftest.h"

#include "engine/mesh/sample_shapes.h"
#include "engine/occluder/mesh_distance.h"
#include "engine/occluder/occluder_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace anvil {

namespace {

constexpr double allowed_deviation = 5e-6;
constexpr double bifurcation = 1e-4; // of the diagonal

std::vector<PointResult> results_of(Backend& backend, const DeformInput& input, const DeformMotion& motion) {
    const auto session = backend.prepare(input);
    session->update(motion);
    return session->download();
}

/// The case's points `picked`, each in several copies: as it is, and moved by 4 float ulps along every axis
/// and in its distances.
constexpr size_t copies = 9;

DeformInput disturbed(const SelftestCase& test, const std::vector<size_t>& picked) {
    const DeformInput& from = test.input;
    constexpr double ulps = 4 * static_cast<double>(std::numeric_limits<float>::epsilon());
    DeformInput input;
    input.handle_count = from.handle_count;
    input.segments = from.segments;
    input.shapes = from.shapes;
    input.occluders = from.occluders;
    input.fields.reserve(from.handle_count * picked.size() * copies);
    for (const size_t i : picked) {
        for (size_t copy = 0; copy < copies; ++copy) {
            Vec3 p = from.points[i];
            if (copy >= 1 && copy <= 6) {
                const auto axis = static_cast<int>((copy - 1) / 2);
                p[axis] += (copy % 2 == 0 ? 1 : -1) * ulps * test.diagonal / 2;
            }
            input.points.push_back(p);
            if (!from.start_distances.empty()) {
                input.start_distances.push_back(from.start_distances[i]);
            }
        }
    }
    for (size_t handle = 0; handle < from.handle_count; ++handle) {
        for (const size_t i : picked) {
            const double t = from.fields[handle * from.points.size() + i];
            input.fields.insert(input.fields.end(), copies - 2, t);
            input.fields.push_back(t * (1 + ulps));
            input.fields.push_back(t * (1 - ulps));
        }
    }
    return input;
}

bool bifurcates(const std::vector<PointResult>& results, size_t first, double diagonal) {
    for (size_t copy = 1; copy < copies; ++copy) {
        const Vec3 change = results[first + copy].displacement - results[first].displacement;
        if (!(glm::length(change) <= bifurcation * diagonal)) {
            return true;
        }
    }
    return false;
}

/// Whether a point that did not start inside ended there.
bool penetrates(const SelftestCase& test, size_t i, const PointResult& result) {
    const DeformInput& input = test.input;
    if (input.occluders.empty() || input.start_distances[i] < 0) {
        return false;
    }
    const double distance =
        exact_distance(at_end(input.occluders), input.points[i] + result.displacement).distance;
    return distance < std::min(0.0, input.start_distances[i]) - allowed_deviation * test.diagonal;
}

} // namespace

bool SelftestResult::passed() const {
    const size_t few = std::max<size_t>(3, points / 1000);
    return non_finite == 0 && deviating == 0 && penetrating == 0 && bifurcating <= few && worst <= allowed;
}

SelftestResult run_selftest_case(Backend& backend, const SelftestCase& test) {
    const auto cpu = make_cpu_backend();
    const std::vector<PointResult> found = results_of(backend, test.input, test.motion);
    const std::vector<PointResult> truth = results_of(*cpu, test.input, test.motion);
    SelftestResult result{.name = test.name,
                          .points = truth.size(),
                          .allowed = allowed_deviation * std::max(1.0, test.lipschitz)};
    std::vector<size_t> beyond;
    for (size_t i = 0; i < truth.size(); ++i) {
        const double difference = glm::length(found[i].displacement - truth[i].displacement) / test.diagonal;
        if (!is_finite(found[i].displacement) || !is_finite(truth[i].displacement)) {
            ++result.non_finite;
        } else if (difference <= result.allowed) {
            result.worst = std::max(result.worst, difference);
        } else {
            beyond.push_back(i);
        }
    }
    const std::vector<PointResult> probes = results_of(*cpu, disturbed(test, beyond), test.motion);
    for (size_t b = 0; b < beyond.size(); ++b) {
        const size_t i = beyond[b];
        if (bifurcates(probes, b * copies, test.diagonal)) {
            ++result.bifurcating;
            result.penetrating += penetrates(test, i, found[i]) ? 1 : 0;
        } else {
            ++result.deviating;
            const double difference =
                glm::length(found[i].displacement - truth[i].displacement) / test.diagonal;
            result.worst = std::max(result.worst, difference);
        }
    }
    return result;
}

SelftestResult run_baking_selftest(SearchDevice& device) {
    Mesh mesh = make_sample("bust", 1000);
    mesh.triangles.resize(mesh.triangles.size() - 20); // a hole: signs by the winding number
    const auto solid = mesh_distance(mesh);
    Progress progress;
    const std::vector<uint32_t> truth = bake_adaptive(*solid, 32, progress).words;
    const std::vector<uint32_t> found = bake_adaptive(*solid, 32, progress, &device).words;
    SelftestResult result{.name = "baked field", .points = truth.size()};
    if (found.size() != truth.size()) { // bricks are other ones
        result.deviating = truth.size();
        return result;
    }
    constexpr uint32_t distance_bits = 0xfff;
    for (size_t i = 0; i < truth.size(); ++i) {
        const uint32_t differs = found[i] ^ truth[i];
        result.deviating += (differs & distance_bits) != 0 ? 1 : 0;
        result.bifurcating += differs != 0 && (differs & distance_bits) == 0 ? 1 : 0;
    }
    return result;
}

} // namespace anvil

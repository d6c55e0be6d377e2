#include "app/bench/step_error.h"

#include <algorithm>
#include <cmath>

namespace anvil {

namespace {

constexpr size_t about_points = 6000;

/// Every so manieth point of an input.
DeformInput thinned(const DeformInput& from, size_t every) {
    const size_t n = from.points.size();
    DeformInput input = from;
    input.points.clear();
    input.fields.clear();
    input.start_distances.clear();
    for (size_t i = 0; i < n; i += every) {
        input.points.push_back(from.points[i]);
        input.start_distances.push_back(from.start_distances[i]);
    }
    for (size_t j = 0; j < from.handle_count; ++j) {
        for (size_t i = 0; i < n; i += every) {
            input.fields.push_back(from.fields[j * n + i]);
        }
    }
    return input;
}

std::vector<PointResult> results_of(Backend& backend, const DeformInput& input, const DeformMotion& motion) {
    const auto session = backend.prepare(input);
    session->update(motion);
    return session->download();
}

} // namespace

StepError step_error(Backend& tested, Backend& reference, const DeformScene& scene, double diagonal) {
    const size_t n = scene.input->points.size();
    const DeformInput input = thinned(*scene.input, std::max<size_t>(n / about_points, 1));
    DeformMotion fine = scene.motion;
    fine.fixed_steps = true;
    fine.steps = converged_steps;
    const std::vector<PointResult> found = results_of(tested, input, scene.motion);
    const std::vector<PointResult> truth = results_of(reference, input, fine);
    std::vector<double> errors;
    errors.reserve(found.size());
    double squares = 0;
    for (size_t i = 0; i < found.size(); ++i) {
        errors.push_back(glm::length(found[i].displacement - truth[i].displacement) / diagonal);
        squares += errors.back() * errors.back();
    }
    const auto place = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 99 / 100);
    std::nth_element(errors.begin(), place, errors.end());
    return {std::sqrt(squares / static_cast<double>(errors.size())), *place};
}

} // namespace anvil

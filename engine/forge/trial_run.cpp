#include "engine/forge/trial_run.h"

#include <algorithm>

namespace anvil {

std::vector<Vec3> TrialRun::moved(std::span<const Vec3> places, const std::vector<double>& distances) {
    const size_t n = places.size();
    input_.points.resize(n);
    std::transform(places.begin(), places.end(), input_.points.begin(),
                   [this](const Vec3& p) { return p - origin_; });
    std::vector<double> fields(distances.size());
    for (size_t i = 0; i < distances.size(); ++i) {
        fields[i] = distances[i] / radii_[i / n];
    }
    if (input_.handle_count > 0) {
        input_.fields = fields;
    }
    find_start_distances(input_);
    const auto session = backend_.prepare(input_);
    session->update(motion_);
    std::vector<Vec3> ends = finished_ends(input_, session->download()).ends;
    for (size_t i = 0; i < n; ++i) {
        bool reached = false;
        for (size_t f = i; f < fields.size(); f += n) {
            reached = reached || fields[f] <= 1;
        }
        ends[i] = reached ? ends[i] + origin_ : places[i];
    }
    return ends;
}

} // namespace anvil

#include "engine/edit/handle_path.h"

#include "engine/core/error.h"

#include <algorithm>
#include <cmath>

namespace anvil {

HandlePath::HandlePath(std::span<const Vec3> offsets) : points_{Vec3(0)}, places_{0} {
    for (const Vec3& offset : offsets) {
        const double segment = glm::length(offset - points_.back());
        if (!std::isfinite(length_ + segment)) {
            throw InputError("the path is longer than numbers can tell; give offsets of the mesh's size");
        }
        if (length_ + segment > length_) {
            length_ += segment;
            points_.push_back(offset);
            places_.push_back(length_);
        } else {
            points_.back() = offset;
        }
    }
    for (double& place : places_) {
        place = length_ > 0 ? place / length_ : 0;
    }
}

std::vector<double> HandlePath::corners() const {
    return places_.size() > 2 ? std::vector<double>(places_.begin() + 1, places_.end() - 1)
                              : std::vector<double>{};
}

Vec3 HandlePath::at(double t) const {
    const auto next = std::lower_bound(places_.begin(), places_.end(), t);
    if (next == places_.end()) {
        return points_.back();
    }
    const auto i = static_cast<size_t>(next - places_.begin());
    if (i == 0 || places_[i] == t) {
        return points_[i];
    }
    const double share = (t - places_[i - 1]) / (places_[i] - places_[i - 1]);
    return points_[i - 1] + share * (points_[i] - points_[i - 1]);
}

} // namespace anvil

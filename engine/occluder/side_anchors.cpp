#include "engine/occluder/side_anchors.h"

#include <algorithm>
#include <cmath>

namespace anvil {

namespace {

constexpr size_t most_anchors = 256;
constexpr size_t seldom = 8; // every so many sums make an anchor where anchors decide less than sums do

} // namespace

/// The balls around both that no face enters cover the way between them.
bool SideAnchors::holds(const Anchor& anchor, const Vec3& p, double distance) const {
    const Vec3 way = p - anchor.position;
    const double reach = std::min(anchor.reach, anchor.free + distance - rounding_);
    return reach > 0 && glm::dot(way, way) < reach * reach;
}

void SideAnchors::keep(const Anchor& anchor) {
    if (anchors_.size() == most_anchors) {
        anchors_.erase(anchors_.begin(), anchors_.begin() + most_anchors / 2);
    }
    anchors_.push_back(anchor);
}

bool SideAnchors::inside(const Vec3& p, double distance) {
    for (size_t i = anchors_.size(); i-- > 0;) {
        if (holds(anchors_[i], p, distance)) {
            ++held_;
            const bool inside = anchors_[i].inside;
            std::swap(anchors_[i], anchors_[std::min(i + 1, anchors_.size() - 1)]);
            return inside;
        }
    }
    ++sums_;
    const double winding = std::abs(winding_.at(p));
    if (held_ >= sums_ || sums_ % seldom == 0) {
        const double spare = std::abs(winding - 0.5) - 2 * WindingNumber::error;
        // Of those that come later, which are nearer to the surface, hardly any is reached farther away.
        if (const double reach = boundary_.reach(p, spare, 2 * distance); reach > 0) {
            keep({p, distance, reach, winding > 0.5});
        }
    }
    return winding > 0.5;
}

} // namespace anvil

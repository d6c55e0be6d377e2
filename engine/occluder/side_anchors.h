// Inside or outside for many points beside each other, without a winding number for each.
#pragma once

#include "engine/core/types.h"
#include "engine/occluder/surface_boundary.h"
#include "engine/occluder/winding_number.h"

#include <cstddef>
#include <vector>

namespace anvil {

/// Says of points what |WindingNumber::at()| > 1/2 says of them. Points whose number was summed, the anchors,
/// stand for those around them: as far as the surface cannot lie between and its boundary cannot have carried
/// the number across 1/2, the errors of both numbers included. For one thread; the fewest sums are needed
/// where points lie close together and those far from the surface come first.
class SideAnchors {
  public:
    /// Both outlive it. `rounding`: what distances may be off.
    SideAnchors(const WindingNumber& winding, const SurfaceBoundary& boundary, double rounding)
        : winding_(winding), boundary_(boundary), rounding_(rounding) {}

    /// `distance` of p to the nearest face.
    bool inside(const Vec3& p, double distance);

    /// How many winding numbers were summed.
    size_t sums() const { return sums_; }

  private:
    struct Anchor {
        Vec3 position;
        double free;  ///< no face is nearer
        double reach; ///< the side holds so far from it, where no face lies between
        bool inside;
    };

    bool holds(const Anchor& anchor, const Vec3& p, double distance) const;
    void keep(const Anchor& anchor);

    const WindingNumber& winding_;
    const SurfaceBoundary& boundary_;
    double rounding_;
    std::vector<Anchor> anchors_; ///< those that were of use more lately are rather at the end
    size_t sums_ = 0;
    size_t held_ = 0; ///< points that anchors decided
};

} // namespace anvil

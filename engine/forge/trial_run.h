// An edit on any points of its surface, for refinement that asks where they would go.
#pragma once

#include "engine/forge/edit_input.h"

#include <span>
#include <vector>

namespace anvil {

class TrialRun {
  public:
    /// `input` and `motion` of the edit, `radii` of its handles, or of what a hammer may act on; `origin`:
    /// the local origin.
    TrialRun(Backend& backend, DeformInput input, DeformMotion motion, std::vector<double> radii,
             const Vec3& origin)
        : backend_(backend), input_(std::move(input)), motion_(std::move(motion)), radii_(std::move(radii)),
          origin_(origin) {}

    /// Where the edit takes the n points at `places` (world), at these distances from its k handles (k x n,
    /// handle by handle), or from what a hammer may act on (n). What lies outside of the region stays, even
    /// where an occluder moves.
    /// @throws DeviceError
    std::vector<Vec3> moved(std::span<const Vec3> places, const std::vector<double>& distances);

  private:
    Backend& backend_;
    DeformInput input_;
    DeformMotion motion_;
    std::vector<double> radii_;
    Vec3 origin_;
};

} // namespace anvil

// The way a handle takes in a path-tracked drag.
#pragma once

#include "engine/core/types.h"

#include <span>
#include <vector>

namespace anvil {

/// A polyline of offsets from the handle's start, by normalized arc length t in [0, 1]. It begins at the
/// start: a first offset other than 0 is reached in a straight line. A path of no length stays at its end
/// for all t.
class HandlePath {
  public:
    /// @throws InputError if the path's length is beyond what double holds.
    explicit HandlePath(std::span<const Vec3> offsets);

    double length() const { return length_; }
    /// t of the offsets between the ends, ascending, each once.
    std::vector<double> corners() const;
    /// Exact at the corners and at the ends.
    Vec3 at(double t) const;

  private:
    std::vector<Vec3> points_;   ///< successive ones differ
    std::vector<double> places_; ///< t of each point
    double length_ = 0;
};

} // namespace anvil

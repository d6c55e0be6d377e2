// Where a surface is open: what bounds how fast its winding number changes.
#pragma once

#include "engine/core/types.h"

#include <cstdint>
#include <span>
#include <vector>

namespace anvil {

/// An edge that bounds more triangles one way round than the other way.
struct BoundaryEdge {
    Vec3 from{0};
    Vec3 to{0};
    double excess = 1; ///< how many more
};

/// Off the surface the winding number w is harmonic, and its gradient at p is that of the surface's boundary
/// alone: the integral of dl x r / (4 pi |r|^3) over the boundary, r from p (Biot and Savart's law). A piece
/// of length l whose points are d or farther away changes w along a way of length s, straight or not, by no
/// more than l / (4 pi) (1 / (d - s) - 1 / d). Without boundary w is constant between crossings. Const, and
/// used from any number of threads.
class SurfaceBoundary {
  public:
    explicit SurfaceBoundary(std::vector<BoundaryEdge> edges = {});

    /// How far a point can go from p, at the most `limit`, if it crosses no face and the winding number is
    /// not to change by more than `change`; zero if `change` is none, and where it would be next to nothing.
    double reach(const Vec3& p, double change, double limit) const;

  private:
    /// Of edges [first, first + count): within `radius` of the centre.
    struct Node {
        Vec3 centre{0};
        double radius = 0;
        double length = 0; ///< each edge as often as it is in excess
        uint32_t first = 0;
        uint32_t count = 0;
        uint32_t children = 0; ///< the first of two, side by side; none if zero
    };
    void split(uint32_t parent);
    void measure(Node& node) const;

    std::vector<BoundaryEdge> edges_;
    std::vector<Node> nodes_;
};

} // namespace anvil

// How often a triangle soup goes around a point: the inside test that holes, overlaps and flipped faces
// survive.
#pragma once

#include "engine/core/types.h"

#include <array>
#include <atomic>
#include <deque>
#include <mutex>
#include <span>
#include <vector>

namespace anvil {

/// Generalized winding number of triangles (Jacobson, Kavan, Sorkine-Hornung 2013): 1 inside and 0 outside a
/// closed surface oriented outwards, -1 inside one oriented inwards, in between near holes. Far triangles are
/// summed by a tree of dipoles with their first derivative (after Barill et al. 2018): off by up to 0.02, and
/// by 0.03 where a surface lies twice. The tree grows where it is asked: where faces tell the side it is
/// hardly needed. Const, and used from any number of threads; what it answers depends on the triangles alone.
class WindingNumber {
  public:
    /// `triangles` index `positions`, all finite. Triangles without area count nothing.
    WindingNumber(std::span<const Vec3> positions, std::span<const Triangle> triangles);

    static constexpr double error = 0.05; ///< more than at() is off

    double at(const Vec3& p) const;

  private:
    struct Corners {
        Vec3 a, b, c;
    };
    struct Node;
    using Children = std::array<Node, 2>;
    /// Moments of the triangles below: area-weighted centre, vector area, first moment of the vector area.
    struct Node {
        Vec3 centre{0};
        Vec3 area{0};
        glm::dmat3 moment{0}; ///< column i: sum of (centre_t - centre)[i] area_t
        double reach = 0;     ///< of the farthest corner from the centre
        uint32_t first = 0;   ///< triangles [first, first + count)
        uint32_t count = 0;
        mutable std::atomic<const Children*> children{
            nullptr}; ///< until they are wanted, and of leaves: none
    };

    void measure(Node& node) const;
    const Children& children(const Node& node) const;
    const Children& split(const Node& node) const;
    static double far_field(const Node& node, const Vec3& arm, double distance);

    Node root_;
    mutable std::mutex growing_;
    mutable std::vector<Corners> triangles_; ///< those of nodes without children are in no order
    mutable std::deque<Children> grown_;
};

} // namespace anvil

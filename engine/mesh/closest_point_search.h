// How ClosestPointTracer finds what is nearest to many queries. Internal to engine/mesh.
#pragma once

#include "engine/mesh/closest_points.h"
#include "engine/mesh/lanes.h"

#include <vector>

namespace anvil {

/// Packets of eight queries that lie together go down the tree at once, in floats, with bounds on what those
/// round away; what these leave open is decided in double. What was nearest to the packet before bounds the
/// search from its beginning. Which nodes and triangles are near is hard to predict: all is written so that
/// processors need not, in lists of which only the count depends on it.
class ClosestPointSearch {
  public:
    explicit ClosestPointSearch(const SearchTree& tree) : tree_(tree) {}

    /// See ClosestPointTracer.
    void run(std::span<const Vec3> queries, std::span<ClosestPoint> found);

  private:
    using Packet = std::span<const uint32_t>; ///< up to `lanes` queries

    static constexpr LaneInts no_leaves{-1, -1, -1, -1, -1, -1, -1, -1};

    /// The lanes' queries.
    struct alignas(lane_alignment) Points {
        std::array<LaneDoubles, 3> exact{};
        std::array<LaneFloats, 3> local{}; ///< around the tree's middle, in units of its diagonal
    };
    /// A leaf's own box as seen from the lanes' queries.
    struct alignas(lane_alignment) Seen {
        LaneFloats squared; ///< distance
        uint32_t leaf = 0;
    };
    struct alignas(lane_alignment) Measured {
        LaneFloats low; ///< least that the lanes' squared distances may be
        uint32_t slot = 0;
    };

    struct Nearest {
        TrianglePoint point;
        uint32_t slot = 0;
    };

    void search(Packet packet);
    void set_points(Packet packet);
    /// Measures the leaves that held what was nearest to the last packet.
    void start_from_known();
    uint32_t a_near_leaf() const;
    /// Finds the leaves with boxes along the axes that may hold what is nearest to a lane's query.
    void descend();
    /// Finds which of these may by the boxes that lie as they do; measures those nearest to a lane.
    void look();
    std::array<LaneFloats, 3> arm_to(uint32_t leaf) const;
    LaneFloats squared_to(uint32_t index) const;
    LaneFloats squared_to(const kernel::f32::TreeNode& node) const;
    /// Adds what the squared distances to a leaf's triangles are at least to measured_, and lowers the limits
    /// to what they are at most.
    void measure(uint32_t index);
    void decide(Packet packet);
    void offer(size_t query, uint32_t slot);
    void remember(uint32_t leaf);
    bool is_known(uint32_t leaf) const { return signs(known_ == static_cast<int>(leaf)) != 0; }
    /// Bits of the lanes whose value is not above their limit; what is not a number is above none.
    static unsigned not_above(const LaneFloats& values, const LaneFloats& limits) {
        return signs(~(values > limits));
    }
    static bool any_not_above(const LaneFloats& values, const LaneFloats& limits) {
        return !all_negative(values > limits);
    }

    Points points_;
    alignas(lane_alignment) LaneFloats limits_{};        ///< of the lanes' squared distances
    alignas(lane_alignment) LaneFloats box_limits_{};    ///< of those of boxes: (root of the limit + blur_)^2
    alignas(lane_alignment) LaneInts known_ = no_leaves; ///< that held what was nearest to the last packet
    const SearchTree& tree_;
    std::vector<Vec3> queries_;   ///< those that floats are good enough for
    std::vector<uint32_t> place_; ///< of each in what is asked
    std::vector<Nearest> nearest_;
    size_t known_count_ = 0;
    float blur_ = 0;               ///< what floats take off distances to boxes
    std::vector<uint32_t> open_;   ///< wide nodes on the way down
    std::vector<uint32_t> leaves_; ///< what the way down finds, the first few of
    size_t leaf_count_ = 0;
    std::vector<Seen> seen_; ///< the first few of
    size_t seen_count_ = 0;
    std::vector<Measured> measured_; ///< the first few of
    size_t measured_count_ = 0;
};

} // namespace anvil

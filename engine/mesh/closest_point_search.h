// How ClosestPointTracer finds what is nearest to many queries. Internal to engine/mesh.
#pragma once

#include "engine/mesh/closest_points.h"
#include "engine/mesh/leaf_views.h"

#include <deque>

namespace anvil {

/// Groups of queries share candidates, which are thinned out from group to part of a group. In floats, with a
/// bound on what those round away; what remains is decided in double.
///
/// What is thinned out: let a surface point be at distance D from the centre of a group of this radius, in
/// direction u, and a convex set at distance E in direction v. From a place w beside the centre the set is at
/// least E - v.w away, being beyond the plane through its nearest point, and the point at most
/// D - u.w + radius^2 / (2 (D - radius)). So it holds nothing nearest to any of the group if
/// E - D > radius |v - u| + radius^2 / (2 (D - radius)), and also if E - D > 2 radius.
class ClosestPointSearch {
  public:
    explicit ClosestPointSearch(const SearchTree& tree) : tree_(tree) {}

    /// See ClosestPointTracer.
    void enter(const Box& box) {
        entered_ = !tree_.nodes_.empty() && !box.empty() && is_finite(box.low) && is_finite(box.high) &&
                   gather(box, tree_.leaves_.size());
        entered_box_ = box;
        if (!entered_) {
            return;
        }
        Parts octants;
        const Vec3 size = 0.5 * (box.high - box.low);
        for (size_t i = 0; i < lanes; ++i) {
            const Vec3 low = box.low + size * Vec3(i & 1, i >> 1 & 1, i >> 2);
            octants.box[i] = {low, low + size};
        }
        octants.count = lanes;
        thin_out(octants, whole_, entered_lists_);
    }

    void run(std::span<const Vec3> queries, std::span<ClosestPoint> found) {
        queries_ = queries;
        found_ = found;
        order_.clear();
        for (uint32_t i = 0; i < queries.size(); ++i) {
            found[i] = {};
            if (is_finite(queries[i]) && !tree_.nodes_.empty()) {
                order_.push_back(i);
            }
        }
        const Box box = box_of(order_);
        if (entered_ && !order_.empty() && glm::all(glm::greaterThanEqual(box.low, entered_box_.low)) &&
            glm::all(glm::lessThanEqual(box.high, entered_box_.high))) {
            narrow_entered();
            return;
        }
        entered_ = false; // what follows gathers anew
        open(order_);
    }

  private:
    static constexpr size_t most_leaves = 2048; ///< that a group without a box starts from
    // Smaller groups and lists are decided as they are.
    static constexpr size_t worth_parting = 20;
    static constexpr size_t worth_thinning = 2;
    static constexpr double rounded = 1e-9; ///< what a few operations in double may take off a result

    using Group = std::span<uint32_t>;  ///< queries
    using List = std::vector<uint32_t>; ///< of leaves_

    struct Parts {
        std::array<Group, lanes> group;
        std::array<Box, lanes> box;
        size_t count = 0;
    };

    /// Queries of the box that was entered, by its octants.
    void narrow_entered() {
        const Vec3 centre = entered_box_.centre();
        const auto octant = [&](uint32_t q) {
            const glm::bvec3 high = glm::greaterThanEqual(queries_[q], centre);
            return (high.x ? 1U : 0U) + (high.y ? 2U : 0U) + (high.z ? 4U : 0U);
        };
        auto begin = order_.begin();
        for (unsigned i = 0; i < lanes; ++i) {
            const auto end = std::partition(begin, order_.end(), [&](uint32_t q) { return octant(q) == i; });
            if (begin != end) {
                const Group group(begin, end);
                narrow(group, box_of(group), entered_lists_[i], 0);
            }
            begin = end;
        }
    }

    Box box_of(Group group) const {
        Box box;
        for (const uint32_t q : group) {
            box.include(queries_[q]);
        }
        return box;
    }

    /// The up to eight parts on either side of the planes through the box's centre.
    Parts split(Group group, const Box& box) const;

    /// The distance found last is a bound for what is near it.
    ClosestPoint closest(const Vec3& query) {
        ClosestPoint found;
        if (last_.found()) {
            const double bound = last_.distance + glm::length(query - last_query_);
            found = tree_.closest(query, (1 + rounded) * bound);
        }
        if (!found.found()) {
            found = tree_.closest(query);
        }
        last_ = found;
        last_query_ = query;
        return found;
    }

    ClosestPoint on_slot(const Vec3& query, uint32_t slot) const {
        const auto& [a, b, c] = tree_.corners_[slot];
        ClosestPoint found = closest_on_triangle(query, a, b, c);
        found.triangle = tree_.order_[slot];
        return found;
    }

    Vec3 local(const Vec3& p) const { return tree_.scale_ * (p - centre_); }

    /// A group without candidates yet.
    void open(Group group) {
        constexpr size_t alone = 4;
        if (group.empty()) {
            return;
        }
        const Box box = box_of(group);
        if (group.size() > alone) {
            if (gather(box, std::min(128 * group.size(), most_leaves))) {
                narrow(group, box, whole_, 0);
                return;
            }
            const Parts parts = split(group, box);
            for (size_t i = 0; i < parts.count && parts.count > 1; ++i) {
                open(parts.group[i]);
            }
            if (parts.count > 1) {
                return;
            }
        }
        for (const uint32_t q : group) {
            found_[q] = closest(queries_[q]);
        }
    }

    /// Finds the leaves that may hold what is nearest to a point of the box; false if they are too many.
    bool gather(const Box& box, size_t most);

    void narrow(Group group, const Box& box, const List& list, size_t depth) {
        if (group.size() > worth_parting && list.size() > worth_thinning) {
            const Parts parts = split(group, box);
            if (parts.count > 1) {
                if (lists_.size() <= depth) {
                    lists_.resize(depth + 1);
                }
                thin_out(parts, list, lists_[depth]);
                for (size_t i = 0; i < parts.count; ++i) {
                    narrow(parts.group[i], parts.box[i], lists_[depth][i], depth + 1);
                }
                return;
            }
        }
        for (size_t i = 0; i < group.size(); i += lanes) {
            decide(group.subspan(i, std::min(lanes, group.size() - i)), list);
        }
    }

    /// What a leaf must not be beyond, for the parts of a group; see the formula above.
    struct alignas(lane_alignment) Horizons {
        LaneFloats radius;
        LaneFloats distance;
        std::array<LaneFloats, 3> towards;
        LaneFloats curve;
    };

    /// What of a list may be nearest to each of the parts' boxes.
    void thin_out(const Parts& parts, const List& list, std::array<List, lanes>& kept_lists);

    /// By the point nearest to the centre of what is in the leaf of the nearest box: not the nearest of all,
    /// but near that.
    void set_horizon(Horizons& horizons, size_t lane, const Box& part, const NearLeaf& leaf) const;

    /// Bits of the parts for which a leaf holds nothing. What is not a number puts it beyond nothing.
    unsigned beyond(const Horizons& horizons, const NearLeaf& leaf, const LeafView& view) const;

    /// What is in the nearest box bounds the search in the others.
    void decide(Group group, const List& list);

    /// What the squared distance of a lane's query is at most.
    void lower(size_t lane, float limit);

    /// Bits of the lanes whose value is not above their limit; what is not a number is above none.
    static unsigned not_above(const LaneFloats& values, const LaneFloats& limits);

    /// Adds what the squared distances to a leaf's triangles are at least to measured_; the most that the
    /// nearest can be at.
    float measure(size_t lane, const NearLeaf& leaf, const Vec3& query, float limit);

    static uint32_t first_slot(const NearLeaf& leaf) {
        return leaf.index * static_cast<uint32_t>(SearchTree::leaf_size);
    }
    uint32_t count_of(const NearLeaf& leaf) const {
        return static_cast<uint32_t>(
            std::min(SearchTree::leaf_size, tree_.corners_.size() - first_slot(leaf)));
    }

    void offer(uint32_t query, uint32_t slot);

    struct Measured {
        size_t lane;
        Float4 low; ///< least that the squared distances may be
        const NearLeaf* leaf;
    };

    alignas(lane_alignment) LaneFloats limits_{};     ///< of squared distances, of the queries being decided
    alignas(lane_alignment) LaneFloats box_limits_{}; ///< and to boxes: (root of the limit + blur_)^2
    const SearchTree& tree_;
    std::span<const Vec3> queries_;
    std::span<ClosestPoint> found_;
    std::vector<uint32_t> order_;
    ClosestPoint last_;
    Vec3 last_query_{0};
    Box entered_box_;
    std::array<List, lanes> entered_lists_; ///< of its octants

    Vec3 centre_{0};
    std::vector<uint32_t> near_; ///< leaves of the tree
    std::vector<NearLeaf> leaves_;
    List whole_; ///< of all of them
    LeafViews views_;
    std::vector<Measured> measured_;
    std::deque<std::array<List, lanes>> lists_; ///< of the parts, by depth
    float blur_ = 0;                            ///< what floats take off distances to boxes
    bool entered_ = false;                      ///< what is gathered is good for entered_box_
};

} // namespace anvil

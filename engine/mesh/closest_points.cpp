#include "engine/mesh/closest_points.h"

#include "engine/mesh/leaf_views.h"

#include <bit>
#include <cmath>
#include <deque>
#include <numeric>

namespace anvil {

namespace {

constexpr size_t most_leaves = 2048;
// Smaller groups and lists are decided as they are.
constexpr size_t worth_parting = 20;
constexpr size_t worth_thinning = 2;
// What a few operations in double or float may take off a result.
constexpr double rounded = 1e-9;
constexpr float rounded_float = 1e-5F;

/// A point at a distance, seen from up to `radius` beside: how much farther it may be than the plane through
/// it across the first line of sight.
template <class Real>
Real farther_than_plane(Real radius, Real distance) {
    return distance > Real(1.5) * radius ? Real(0.5) * radius * radius / (distance - radius)
                                         : std::numeric_limits<Real>::infinity();
}

} // namespace

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
        entered_ = !tree_.nodes_.empty() && !box.empty() && gather(box, most_leaves);
        entered_box_ = box;
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
            narrow(order_, box, whole_, 0);
            return;
        }
        entered_ = false; // what follows gathers anew
        open(order_);
    }

  private:
    using Group = std::span<uint32_t>;  ///< queries
    using List = std::vector<uint32_t>; ///< of leaves_

    struct Parts {
        std::array<Group, lanes> group;
        std::array<Box, lanes> box;
        size_t count = 0;
    };

    Box box_of(Group group) const {
        Box box;
        for (const uint32_t q : group) {
            box.include(queries_[q]);
        }
        return box;
    }

    /// The up to eight parts on either side of the planes through the box's centre.
    Parts split(Group group, const Box& box) const {
        const Vec3 centre = box.centre();
        Parts parts;
        parts.group[0] = group;
        parts.count = 1;
        for (int axis = 0; axis < 3; ++axis) {
            for (size_t i = parts.count; i-- > 0;) {
                const Group whole = parts.group[i];
                const auto second = std::partition(
                    whole.begin(), whole.end(), [&](uint32_t q) { return queries_[q][axis] < centre[axis]; });
                const auto low = static_cast<size_t>(second - whole.begin());
                if (low > 0 && low < whole.size()) {
                    parts.group[i] = whole.first(low);
                    parts.group[parts.count++] = whole.subspan(low);
                }
            }
        }
        for (size_t i = 0; i < parts.count; ++i) {
            parts.box[i] = box_of(parts.group[i]);
        }
        return parts;
    }

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
    bool gather(const Box& box, size_t most) {
        centre_ = box.centre();
        const ClosestPoint nearest = closest(centre_);
        const Vec3 towards = (nearest.position - centre_) / nearest.distance;
        const double radius = 0.5 * box.diagonal();
        const double curve = farther_than_plane(radius, nearest.distance);
        near_.clear();
        tree_.each_leaf(
            [&](const Box& other) {
                const Vec3 arm = glm::clamp(centre_, other.low, other.high) - centre_;
                const double distance = glm::length(arm);
                const double farther = (1 - rounded) * distance - nearest.distance;
                return !(farther > 2 * radius) &&
                       !(farther > radius * glm::length(arm / distance - towards) + curve);
            },
            [&](const SearchTree::Node& leaf) {
                near_.push_back(leaf.first / static_cast<uint32_t>(SearchTree::leaf_size));
                return near_.size() <= most;
            });
        if (near_.size() > most) {
            return false;
        }
        blur_ = rounded_float * static_cast<float>((nearest.distance + radius) * tree_.scale_);
        leaves_.clear();
        for (const uint32_t index : near_) {
            const SearchTree::Leaf& leaf = tree_.leaves_[index];
            leaves_.push_back({glm::vec3(local(leaf.centre)), leaf.axes, leaf.half, index});
        }
        whole_.resize(leaves_.size());
        std::iota(whole_.begin(), whole_.end(), 0U);
        return true;
    }

    void narrow(Group group, const Box& box, const List& list, size_t depth) {
        if (group.size() > worth_parting && list.size() > worth_thinning) {
            const Parts parts = split(group, box);
            if (parts.count > 1) {
                thin_out(parts, list, depth);
                return;
            }
        }
        for (size_t i = 0; i < group.size(); i += lanes) {
            decide(group.subspan(i, std::min(lanes, group.size() - i)), list);
        }
    }

    /// What a leaf must not be beyond, for four parts of a group; see the formula above.
    struct Horizon {
        Float4 radius;
        Float4 distance;
        std::array<Float4, 3> towards;
        Float4 curve;
    };

    void thin_out(const Parts& parts, const List& list, size_t depth) {
        LanePoints centres;
        for (size_t i = 0; i < parts.count; ++i) {
            centres.set(i, local(parts.box[i].centre()));
        }
        const std::array<uint32_t, lanes> nearest = views_.look<true>(leaves_, list, centres);
        std::array<Horizon, quads> horizons{};
        for (size_t i = 0; i < parts.count; ++i) {
            set_horizon(horizons[i / 4], i % 4, parts.box[i], leaves_[list[nearest[i]]]);
        }
        if (lists_.size() <= depth) {
            lists_.resize(depth + 1);
        }
        for (List& part : lists_[depth]) {
            part.clear();
        }
        for (size_t k = 0; k < list.size(); ++k) {
            unsigned out = 0;
            for (size_t quad = 0; quad < quads; ++quad) {
                out |= beyond(horizons[quad], leaves_[list[k]], views_[k], quad) << (4 * quad);
            }
            for (unsigned kept = ~out & ((1U << parts.count) - 1); kept != 0; kept &= kept - 1) {
                lists_[depth][static_cast<size_t>(std::countr_zero(kept))].push_back(list[k]);
            }
        }
        for (size_t i = 0; i < parts.count; ++i) {
            narrow(parts.group[i], parts.box[i], lists_[depth][i], depth + 1);
        }
    }

    /// By the point nearest to the centre of what is in the leaf of the nearest box: not the nearest of all,
    /// but near that.
    void set_horizon(Horizon& horizon, size_t lane, const Box& part, const NearLeaf& leaf) const {
        const Vec3 centre = part.centre();
        const SearchTree::SquaredBounds squared = tree_.squared_distances(tree_.leaves_[leaf.index], centre);
        uint32_t best = 0;
        for (uint32_t i = 1; i < count_of(leaf); ++i) {
            best = squared.low[i] < squared.low[best] ? i : best;
        }
        const ClosestPoint point = on_slot(centre, first_slot(leaf) + best);
        const double radius = 0.5 * part.diagonal();
        const Vec3 towards = (point.position - centre) / point.distance;
        horizon.radius[lane] = static_cast<float>(tree_.scale_ * radius);
        horizon.distance[lane] = static_cast<float>(tree_.scale_ * point.distance);
        horizon.curve[lane] = static_cast<float>(tree_.scale_ * farther_than_plane(radius, point.distance));
        for (int axis = 0; axis < 3; ++axis) {
            horizon.towards[axis][lane] = static_cast<float>(towards[axis]);
        }
    }

    /// Bits of the parts for which a leaf holds nothing. What is not a number puts it beyond nothing.
    unsigned beyond(const Horizon& horizon, const NearLeaf& leaf, const LeafView& view, size_t quad) const {
        const Float4 distance = square_root(view.squared[quad]);
        const Float4 farther = distance - horizon.distance - blur_;
        const auto& [x, y, z] = horizon.towards;
        Float4 along{};
        for (int axis = 0; axis < 3; ++axis) {
            const glm::vec3& a = leaf.axes[axis];
            along += view.arm[axis][quad] * (a.x * x + a.y * y + a.z * z);
        }
        const Float4 apart = square_root(2 - 2 * along / distance + rounded_float);
        return signs((farther > 2 * horizon.radius) | (farther > horizon.radius * apart + horizon.curve));
    }

    /// What is in the nearest box bounds the search in the others.
    void decide(Group group, const List& list) {
        LanePoints points;
        for (size_t i = 0; i < group.size(); ++i) {
            points.set(i, local(queries_[group[i]]));
        }
        const std::array<uint32_t, lanes> nearest = views_.look<false>(leaves_, list, points);
        measured_.clear();
        limits_.fill(four(largest_float));
        box_limits_ = limits_;
        for (size_t i = 0; i < group.size(); ++i) {
            lower(i, measure(i, leaves_[list[nearest[i]]], queries_[group[i]], largest_float));
        }
        const unsigned used = (1U << group.size()) - 1;
        for (size_t k = 0; k < list.size(); ++k) {
            for (unsigned near = not_above(views_[k].squared, box_limits_) & used; near != 0;
                 near &= near - 1) {
                const auto i = static_cast<size_t>(std::countr_zero(near));
                if (k != nearest[i]) {
                    lower(i, measure(i, leaves_[list[k]], queries_[group[i]], limits_[i / 4][i % 4]));
                }
            }
        }
        for (const auto& [lane, low, leaf] : measured_) {
            const unsigned lowest = signs(~(low > limits_[lane / 4][lane % 4]));
            for (unsigned near = lowest & ((1U << count_of(*leaf)) - 1); near != 0; near &= near - 1) {
                offer(group[lane], first_slot(*leaf) + static_cast<uint32_t>(std::countr_zero(near)));
            }
        }
    }

    /// What the squared distance of a lane's query is at most.
    void lower(size_t lane, float limit) {
        if (limit < limits_[lane / 4][lane % 4]) {
            limits_[lane / 4][lane % 4] = limit;
            box_limits_[lane / 4][lane % 4] = limit + blur_ * (2 * std::sqrt(limit) + blur_);
        }
    }

    /// Bits of the lanes whose value is not above their limit; what is not a number is above none.
    static unsigned not_above(const LaneFloats& values, const LaneFloats& limits) {
        unsigned bits = 0;
        for (size_t quad = 0; quad < quads; ++quad) {
            bits |= signs(~(values[quad] > limits[quad])) << (4 * quad);
        }
        return bits;
    }

    /// Adds what the squared distances to a leaf's triangles are at least to measured_; the most that the
    /// nearest can be at.
    float measure(size_t lane, const NearLeaf& leaf, const Vec3& query, float limit) {
        const auto [low, high] = tree_.squared_distances(tree_.leaves_[leaf.index], query);
        measured_.push_back({lane, low, &leaf});
        for (uint32_t i = 0; i < count_of(leaf); ++i) {
            limit = high[i] < limit ? high[i] : limit;
        }
        return limit;
    }

    static uint32_t first_slot(const NearLeaf& leaf) {
        return leaf.index * static_cast<uint32_t>(SearchTree::leaf_size);
    }
    uint32_t count_of(const NearLeaf& leaf) const {
        return static_cast<uint32_t>(
            std::min(SearchTree::leaf_size, tree_.corners_.size() - first_slot(leaf)));
    }

    void offer(uint32_t query, uint32_t slot) {
        const ClosestPoint there = on_slot(queries_[query], slot);
        ClosestPoint& best = found_[query];
        if (there.distance < best.distance ||
            (there.distance == best.distance && there.triangle < best.triangle)) {
            best = there;
        }
    }

    struct Measured {
        size_t lane;
        Float4 low; ///< least that the squared distances may be
        const NearLeaf* leaf;
    };

    const SearchTree& tree_;
    std::span<const Vec3> queries_;
    std::span<ClosestPoint> found_;
    std::vector<uint32_t> order_;
    ClosestPoint last_;
    Vec3 last_query_{0};
    bool entered_ = false; ///< what is gathered is good for entered_box_
    Box entered_box_;

    Vec3 centre_{0};
    float blur_ = 0;             ///< what floats take off distances to boxes
    std::vector<uint32_t> near_; ///< leaves of the tree
    std::vector<NearLeaf> leaves_;
    List whole_; ///< of all of them
    LeafViews views_;
    LaneFloats limits_{};     ///< of squared distances, of the queries being decided
    LaneFloats box_limits_{}; ///< and to boxes: (root of the limit + blur_)^2
    std::vector<Measured> measured_;
    std::deque<std::array<List, lanes>> lists_; ///< of the parts, by depth
};

ClosestPointTracer::ClosestPointTracer(const SearchTree& tree)
    : search_(std::make_unique<ClosestPointSearch>(tree)) {}

ClosestPointTracer::~ClosestPointTracer() = default;

void ClosestPointTracer::enter(const Box& box) {
    search_->enter(box);
}

void ClosestPointTracer::closest(std::span<const Vec3> queries, std::span<ClosestPoint> found) {
    search_->run(queries, found);
}

} // namespace anvil

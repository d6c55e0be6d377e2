#include "engine/mesh/closest_point_search.h"

#include "engine/mesh/place_order.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace anvil {

namespace {

// What floats take off distances to boxes, as a share of the largest coordinate at work: a point and a box
// are each off by 2^-24 of it; turning the arm between them into the box's axes, which are off by 2^-24
// themselves, and adding the squares takes off another 12 of these at most. This is twice as much.
constexpr float rounded_float = 2e-6F;
// In diagonals: beyond, floats see little of the tree.
constexpr double far_away = 100;

/// Into the cache of the processor.
template <class T>
void fetch_soon(const T& data) {
    constexpr size_t line = 64;
    const char* begin = reinterpret_cast<const char*>(&data);
    for (size_t at = 0; at < sizeof(T); at += line) {
        __builtin_prefetch(begin + at);
    }
}

} // namespace

void ClosestPointSearch::run(std::span<const Vec3> queries, std::span<ClosestPoint> found) {
    queries_.clear();
    place_.clear();
    for (uint32_t i = 0; i < queries.size(); ++i) {
        const Vec3 arm = tree_.scale_ * (queries[i] - tree_.middle_);
        if (glm::dot(arm, arm) < far_away * far_away && !tree_.nodes_.empty()) {
            queries_.push_back(queries[i]);
            place_.push_back(i);
        } else {
            found[i] = tree_.closest(queries[i]);
        }
    }
    nearest_.assign(queries_.size(), {});
    const std::vector<uint32_t> order = order_by_place(queries_);
    for (size_t i = 0; i < order.size(); i += lanes) {
        search(Packet(order).subspan(i, std::min(lanes, order.size() - i)));
    }
    for (size_t i = 0; i < place_.size(); ++i) {
        const auto& [point, slot] = nearest_[i];
        found[place_[i]] = {tree_.order_[slot], point.barycentric, tree_.corners_[slot].a + point.offset,
                            std::sqrt(point.distance2)};
    }
}

// What is decided in double, by nearest_on_triangle(), stands in another file: it is compiled once, and the
// same for every processor.
ANVIL_FOR_PROCESSOR void ClosestPointSearch::search(Packet packet) {
    set_points(packet);
    start_from_known();
    descend();
    look();
    for (size_t i = 0; i < seen_count_; ++i) {
        if (any_not_above(seen_[i].squared, box_limits_)) {
            measure(seen_[i].leaf);
        }
    }
    decide(packet);
}

void ClosestPointSearch::set_points(Packet packet) {
    std::array<Vec3, lanes> points;
    for (size_t i = 0; i < lanes; ++i) {
        points[i] = queries_[packet[std::min(i, packet.size() - 1)]];
    }
    LaneFloats farthest{};
    for (int axis = 0; axis < 3; ++axis) {
        auto& [low, high] = points_.exact[axis].half;
        low = Double4{points[0][axis], points[1][axis], points[2][axis], points[3][axis]};
        high = Double4{points[4][axis], points[5][axis], points[6][axis], points[7][axis]};
        points_.local[axis] = narrowed(points_.exact[axis], tree_.middle_[axis], tree_.scale_);
        farthest = most(farthest, absolute(points_.local[axis]));
    }
    float far = 0;
    for (size_t i = 0; i < lanes; ++i) {
        far = std::max(far, farthest[i]);
    }
    blur_ = rounded_float * (1 + 2 * far);
}

void ClosestPointSearch::start_from_known() {
    measured_count_ = 0;
    limits_ = all_lanes(largest_float);
    box_limits_ = limits_;
    if (known_count_ == 0) {
        remember(a_near_leaf());
    }
    for (size_t i = 0; i < known_count_; ++i) {
        measure(static_cast<uint32_t>(known_[i]));
    }
}

/// By always going to the nearest child.
uint32_t ClosestPointSearch::a_near_leaf() const {
    kernel::f32::TreeNode best{};
    do {
        float least_squared = std::numeric_limits<float>::infinity();
        for (const kernel::f32::TreeNode& child : tree_.wide_nodes_[best.first].children) {
            const float squared = squared_to(child)[0];
            if (squared < least_squared) {
                least_squared = squared;
                best = child;
            }
        }
    } while (best.count == 0);
    return best.first;
}

// Level by level, and without branches but the loop's: what is near is hard to predict, and so the processor
// can begin with nodes while it is at others.
void ClosestPointSearch::descend() {
    constexpr size_t width = SearchTree::WideNode{}.children.size();
    leaf_count_ = 0;
    size_t count = 1;
    open_.resize(std::max<size_t>(open_.size(), 64));
    open_[0] = 0;
    for (size_t i = 0; i < count; ++i) {
        if (open_.size() < count + width) {
            open_.resize(2 * count + 64);
        }
        if (leaves_.size() < leaf_count_ + width) {
            leaves_.resize(2 * leaf_count_ + 64);
        }
        for (const kernel::f32::TreeNode& child : tree_.wide_nodes_[open_[i]].children) {
            const size_t near = any_not_above(squared_to(child), box_limits_) ? 1 : 0;
            const size_t leaf = child.count > 0 ? near : 0;
            leaves_[leaf_count_] = child.first;
            leaf_count_ += leaf;
            open_[count] = child.first;
            count += near - leaf;
        }
    }
}

LaneFloats ClosestPointSearch::squared_to(const kernel::f32::TreeNode& node) const {
    LaneFloats squared{};
    for (int axis = 0; axis < 3; ++axis) {
        const LaneFloats& p = points_.local[axis];
        const LaneFloats gap = p - least(most(p, all_lanes(node.low[axis])), all_lanes(node.high[axis]));
        squared += gap * gap;
    }
    return squared;
}

void ClosestPointSearch::look() {
    seen_.resize(std::max(seen_.size(), leaf_count_ + 1));
    seen_count_ = 0;
    LaneFloats lowest = all_lanes(largest_float);
    LaneInts nearest = LaneInts{} - 1;
    for (size_t i = 0; i < leaf_count_; ++i) {
        __builtin_prefetch(&tree_.leaf_boxes_[leaves_[std::min(i + 8, leaf_count_ - 1)]]);
        const LaneFloats squared = squared_to(leaves_[i]);
        const bool counts = any_not_above(squared, box_limits_) & !is_known(leaves_[i]);
        seen_[seen_count_] = {squared, leaves_[i]};
        const LaneInts nearer = (squared < lowest) & (counts ? -1 : 0);
        lowest = nearer ? squared : lowest;
        nearest = nearer ? LaneInts{} + static_cast<int>(seen_count_) : nearest;
        seen_count_ += counts ? 1 : 0;
        fetch_soon(tree_.leaves_[leaves_[i]]);
    }
    for (size_t lane = 0; lane < lanes; ++lane) {
        if (nearest[lane] >= 0) {
            Seen& seen = seen_[static_cast<size_t>(nearest[lane])];
            if (any_not_above(seen.squared, box_limits_)) {
                measure(seen.leaf);
            }
            seen.squared = all_lanes(std::numeric_limits<float>::infinity());
        }
    }
}

std::array<LaneFloats, 3> ClosestPointSearch::arm_to(uint32_t leaf) const {
    std::array<LaneFloats, 3> arm;
    const Vec3& centre = tree_.leaves_[leaf].centre;
    for (int axis = 0; axis < 3; ++axis) {
        arm[axis] = narrowed(points_.exact[axis], centre[axis], tree_.scale_);
    }
    return arm;
}

LaneFloats ClosestPointSearch::squared_to(uint32_t index) const {
    const SearchTree::LeafBox& leaf = tree_.leaf_boxes_[index];
    const LaneFloats x = points_.local[0] - leaf.place.x;
    const LaneFloats y = points_.local[1] - leaf.place.y;
    const LaneFloats z = points_.local[2] - leaf.place.z;
    LaneFloats squared{};
    for (int axis = 0; axis < 3; ++axis) {
        const glm::vec3& a = leaf.axes[axis];
        const LaneFloats along = absolute(a.x * x + a.y * y + a.z * z);
        const LaneFloats gap = not_negative(along - leaf.half[axis]);
        squared += gap * gap;
    }
    return squared;
}

void ClosestPointSearch::measure(uint32_t index) {
    if (measured_.size() < measured_count_ + SearchTree::leaf_size) {
        measured_.resize(2 * measured_count_ + 64);
    }
    const SearchTree::Leaf& leaf = tree_.leaves_[index];
    const auto first = index * static_cast<uint32_t>(SearchTree::leaf_size);
    const auto count = static_cast<uint32_t>(std::min(SearchTree::leaf_size, tree_.corners_.size() - first));
    const std::array<LaneFloats, 3> arm = arm_to(index);
    const LaneFloats lengths = leaf.reach + absolute(arm[0]) + absolute(arm[1]) + absolute(arm[2]);
    const LaneFloats error = lengths * (kernel::f32::FLAT_ROUNDING * lengths + 2 * leaf.slack);
    for (uint32_t i = 0; i < count; ++i) {
        const LaneFloats squared = squared_distance(
            leaf.flat, i,
            {arm[0] - leaf.origins[0][i], arm[1] - leaf.origins[1][i], arm[2] - leaf.origins[2][i]});
        limits_ = least(squared + error, limits_);
        const LaneFloats low = squared - error;
        measured_[measured_count_] = {low, first + i};
        measured_count_ += any_not_above(low, limits_) ? 1 : 0;
    }
    box_limits_ = limits_ + blur_ * (2 * square_root(limits_) + blur_);
}

void ClosestPointSearch::decide(Packet packet) {
    known_count_ = 0;
    known_ = no_leaves;
    const unsigned used = (1U << packet.size()) - 1;
    for (size_t i = 0; i < measured_count_; ++i) {
        const auto& [low, slot] = measured_[i];
        const unsigned near_lanes = not_above(low, limits_) & used;
        for (unsigned near = near_lanes; near != 0; near &= near - 1) {
            offer(packet[static_cast<size_t>(std::countr_zero(near))], slot);
        }
        if (near_lanes != 0) {
            remember(slot / static_cast<uint32_t>(SearchTree::leaf_size));
        }
    }
}

void ClosestPointSearch::remember(uint32_t leaf) {
    if (known_count_ < lanes && !is_known(leaf)) {
        known_[known_count_++] = static_cast<int>(leaf);
    }
}

void ClosestPointSearch::offer(size_t query, uint32_t slot) {
    const auto& [a, b, c] = tree_.corners_[slot];
    const TrianglePoint there = nearest_on_triangle(queries_[query], a, b, c);
    Nearest& best = nearest_[query];
    if (there.distance2 < best.point.distance2 ||
        (there.distance2 == best.point.distance2 && tree_.order_[slot] < tree_.order_[best.slot])) {
        best = {there, slot};
    }
}

ClosestPointTracer::ClosestPointTracer(const SearchTree& tree)
    : search_(std::make_unique<ClosestPointSearch>(tree)) {}

ClosestPointTracer::~ClosestPointTracer() = default;

void ClosestPointTracer::closest(std::span<const Vec3> queries, std::span<ClosestPoint> found) {
    search_->run(queries, found);
}

} // namespace anvil

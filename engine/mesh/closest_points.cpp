#include "engine/mesh/closest_point_search.h"

#include <bit>
#include <cmath>
#include <numeric>

namespace anvil {

namespace {

constexpr float rounded_float = 1e-5F; // what a few operations in float may take off a result

/// A point at a distance, seen from up to `radius` beside: how much farther it may be than the plane through
/// it across the first line of sight.
template <class Real>
Real farther_than_plane(Real radius, Real distance) {
    return distance > Real(1.5) * radius ? Real(0.5) * radius * radius / (distance - radius)
                                         : std::numeric_limits<Real>::infinity();
}

} // namespace

ClosestPointSearch::Parts ClosestPointSearch::split(Group group, const Box& box) const {
    const Vec3 centre = box.centre();
    Parts parts;
    parts.group[0] = group;
    parts.count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        for (size_t i = parts.count; i-- > 0;) {
            const Group whole = parts.group[i];
            const auto second = std::partition(whole.begin(), whole.end(),
                                               [&](uint32_t q) { return queries_[q][axis] < centre[axis]; });
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

bool ClosestPointSearch::gather(const Box& box, size_t most) {
    centre_ = box.centre();
    const ClosestPoint nearest = closest(centre_);
    const Vec3 towards = (nearest.position - centre_) / nearest.distance;
    const double radius = 0.5 * box.diagonal();
    const double curve = farther_than_plane(radius, nearest.distance);
    // Most boxes are decided without a root; what is not a number is beyond nothing.
    const double surely_near = nearest.distance * nearest.distance;
    const double limit = (1 + 3 * rounded) * (nearest.distance + 2 * radius);
    const double surely_far = limit * limit;
    near_.clear();
    tree_.each_leaf(
        [&](const Box& other) {
            const Vec3 arm = glm::clamp(centre_, other.low, other.high) - centre_;
            const double squared = glm::dot(arm, arm);
            if (squared <= surely_near || squared > surely_far) {
                return !(squared > surely_far);
            }
            const double distance = std::sqrt(squared);
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

ANVIL_FOR_PROCESSOR void ClosestPointSearch::thin_out(const Parts& parts, const List& list,
                                                      std::array<List, lanes>& kept_lists) {
    LanePoints centres;
    for (size_t i = 0; i < parts.count; ++i) {
        centres.set(i, local(parts.box[i].centre()));
    }
    const std::array<uint32_t, lanes> nearest = views_.look<true>(leaves_, list, centres);
    Horizons horizons{};
    for (size_t i = 0; i < parts.count; ++i) {
        set_horizon(horizons, i, parts.box[i], leaves_[list[nearest[i]]]);
    }
    for (List& part : kept_lists) {
        part.clear();
    }
    for (size_t k = 0; k < list.size(); ++k) {
        const unsigned out = beyond(horizons, leaves_[list[k]], views_[k]);
        for (unsigned kept = ~out & ((1U << parts.count) - 1); kept != 0; kept &= kept - 1) {
            kept_lists[static_cast<size_t>(std::countr_zero(kept))].push_back(list[k]);
        }
    }
}

void ClosestPointSearch::set_horizon(Horizons& horizons, size_t lane, const Box& part,
                                     const NearLeaf& leaf) const {
    const Vec3 centre = part.centre();
    const SearchTree::SquaredBounds squared = tree_.squared_distances(tree_.leaves_[leaf.index], centre);
    uint32_t best = 0;
    for (uint32_t i = 1; i < count_of(leaf); ++i) {
        best = squared.low[i] < squared.low[best] ? i : best;
    }
    const ClosestPoint point = on_slot(centre, first_slot(leaf) + best);
    const double radius = 0.5 * part.diagonal();
    const Vec3 towards = (point.position - centre) / point.distance;
    horizons.radius[lane] = static_cast<float>(tree_.scale_ * radius);
    horizons.distance[lane] = static_cast<float>(tree_.scale_ * point.distance);
    horizons.curve[lane] = static_cast<float>(tree_.scale_ * farther_than_plane(radius, point.distance));
    for (int axis = 0; axis < 3; ++axis) {
        horizons.towards[axis][lane] = static_cast<float>(towards[axis]);
    }
}

unsigned ClosestPointSearch::beyond(const Horizons& horizons, const NearLeaf& leaf,
                                    const LeafView& view) const {
    LaneFloats distance = view.squared;
    take_root(distance);
    const LaneFloats farther = distance - horizons.distance - blur_;
    const auto& [x, y, z] = horizons.towards;
    LaneFloats along{};
    for (int axis = 0; axis < 3; ++axis) {
        const glm::vec3& a = leaf.axes[axis];
        along += view.arm[axis] * (a.x * x + a.y * y + a.z * z);
    }
    LaneFloats apart = 2 - 2 * along / distance + rounded_float;
    take_root(apart);
    return signs((farther > 2 * horizons.radius) | (farther > horizons.radius * apart + horizons.curve));
}

ANVIL_FOR_PROCESSOR void ClosestPointSearch::decide(Group group, const List& list) {
    LanePoints points;
    for (size_t i = 0; i < group.size(); ++i) {
        points.set(i, local(queries_[group[i]]));
    }
    const std::array<uint32_t, lanes> nearest = views_.look<false>(leaves_, list, points);
    measured_.clear();
    fill(limits_, largest_float);
    box_limits_ = limits_;
    for (size_t i = 0; i < group.size(); ++i) {
        lower(i, measure(i, leaves_[list[nearest[i]]], queries_[group[i]], largest_float));
    }
    const unsigned used = (1U << group.size()) - 1;
    for (size_t k = 0; k < list.size(); ++k) {
        for (unsigned near = not_above(views_[k].squared, box_limits_) & used; near != 0; near &= near - 1) {
            const auto i = static_cast<size_t>(std::countr_zero(near));
            if (k != nearest[i]) {
                lower(i, measure(i, leaves_[list[k]], queries_[group[i]], limits_[i]));
            }
        }
    }
    for (const auto& [lane, low, leaf] : measured_) {
        const unsigned lowest = signs(~(low > limits_[lane]));
        for (unsigned near = lowest & ((1U << count_of(*leaf)) - 1); near != 0; near &= near - 1) {
            offer(group[lane], first_slot(*leaf) + static_cast<uint32_t>(std::countr_zero(near)));
        }
    }
}

void ClosestPointSearch::lower(size_t lane, float limit) {
    if (limit < limits_[lane]) {
        limits_[lane] = limit;
        box_limits_[lane] = limit + blur_ * (2 * std::sqrt(limit) + blur_);
    }
}

unsigned ClosestPointSearch::not_above(const LaneFloats& values, const LaneFloats& limits) {
    return signs(~(values > limits));
}

float ClosestPointSearch::measure(size_t lane, const NearLeaf& leaf, const Vec3& query, float limit) {
    const auto [low, high] = tree_.squared_distances(tree_.leaves_[leaf.index], query);
    measured_.push_back({lane, low, &leaf});
    for (uint32_t i = 0; i < count_of(leaf); ++i) {
        limit = high[i] < limit ? high[i] : limit;
    }
    return limit;
}

void ClosestPointSearch::offer(uint32_t query, uint32_t slot) {
    const ClosestPoint there = on_slot(queries_[query], slot);
    ClosestPoint& best = found_[query];
    if (there.distance < best.distance ||
        (there.distance == best.distance && there.triangle < best.triangle)) {
        best = there;
    }
}

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

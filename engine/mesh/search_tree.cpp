#include "engine/mesh/search_tree.h"

#include <array>
#include <iterator>

namespace anvil {

namespace {

constexpr int bin_count = 16;
constexpr double least_square = 1e-200; // of lengths that are divided by, far from underflow

double dot2(const Vec3& v) {
    return glm::dot(v, v);
}

/// Parameter in [0, 1] of the point of segment ab nearest to a + ap; 0 if the segment is a point.
double segment_parameter(const Vec3& ap, const Vec3& ab) {
    const double length2 = dot2(ab);
    return length2 > 0 ? std::clamp(glm::dot(ap, ab) / length2, 0.0, 1.0) : 0.0;
}

void offer(TrianglePoint& best, const Vec3& weights, const Vec3& from_a, const Vec3& ap) {
    const double d2 = dot2(ap - from_a);
    if (d2 < best.distance2) {
        best = {d2, weights, from_a};
    }
}

/// Weights of b and c at the foot of the perpendicular from ap. In a needle the first solution carries
/// eps / sine; solving again for what is left of ap takes it to rounding.
Vec3 foot(const Vec3& ap, const Vec3& ab, const Vec3& ac, const Vec3& normal, double area2, bool needle) {
    double v = 0;
    double w = 0;
    for (int round = 0; round < (needle ? 3 : 1); ++round) {
        const Vec3 left = ap - (v * ab + w * ac);
        v += glm::dot(glm::cross(left, ac), normal) / area2;
        w += glm::dot(glm::cross(ab, left), normal) / area2;
    }
    return {1 - v - w, v, w};
}

/// Every candidate is a point of the triangle, so that whatever rounding does to a needle's normal, the
/// least distance stands. An edge is tried only if the foot of the perpendicular lies beyond it, or nearly:
/// if it lies within another edge by more than what rounding does, it is nearer to some point of those beyond
/// which it lies than to any of that.
TrianglePoint nearest(const Vec3& ap, const Vec3& ab, const Vec3& ac) {
    constexpr double surely_within = 1e-6;
    TrianglePoint best;
    const Vec3 normal = glm::cross(ab, ac);
    const double area2 = dot2(normal);
    const Vec3 bc = ac - ab;
    const double bc2 = dot2(bc);
    const double sides4 = std::max(dot2(ab), bc2) * std::max(dot2(ac), bc2);
    Vec3 within(0); // of the edges across from a, b, c
    // A normal that is mostly rounding says nothing about inside and outside.
    if (area2 > 1e-24 * sides4) {
        const bool needle = area2 < 1e-6 * sides4;
        const Vec3 weights = foot(ap, ab, ac, normal, area2, needle);
        if (weights.x >= 0 && weights.y >= 0 && weights.z >= 0) {
            offer(best, weights, weights.y * ab + weights.z * ac, ap);
            if (!needle) {
                return best;
            }
        }
        within = needle ? within : weights;
    }
    if (within.z < surely_within) {
        const double on_ab = segment_parameter(ap, ab);
        offer(best, {1 - on_ab, on_ab, 0}, on_ab * ab, ap);
    }
    if (within.y < surely_within) {
        const double on_ac = segment_parameter(ap, ac);
        offer(best, {1 - on_ac, 0, on_ac}, on_ac * ac, ap);
    }
    if (within.x < surely_within) {
        const double on_bc = segment_parameter(ap - ab, bc);
        offer(best, {0, 1 - on_bc, on_bc}, on_bc == 1 ? ac : ab + on_bc * bc, ap);
    }
    return best;
}

double box_distance2(const Box& box, const Vec3& p) {
    return dot2(glm::max(glm::max(box.low - p, p - box.high), Vec3(0)));
}

/// Makes [begin, wanted) the first few items in this order, if there are any.
template <class Iterator, class Before>
void bring_forward(Iterator begin, Iterator wanted, Iterator end, const Before& before) {
    for (; begin < wanted; ++begin) {
        std::iter_swap(begin, std::min_element(begin, end, before));
    }
}

/// Half the surface area; only its ratios matter.
double half_area(const Box& box) {
    const Vec3 e = box.high - box.low;
    return e.x * e.y + e.y * e.z + e.z * e.x;
}

void include(Box& box, const Box& other) {
    box.low = glm::min(box.low, other.low);
    box.high = glm::max(box.high, other.high);
}

struct Bin {
    Box box;
    size_t count = 0;
};

/// The cut between bins that costs least by the surface area heuristic; 0 if all items share one bin.
int best_cut(const std::array<Bin, bin_count>& bins) {
    std::array<double, bin_count> right_cost{};
    Bin right;
    for (int i = bin_count - 1; i > 0; --i) {
        include(right.box, bins[i].box);
        right.count += bins[i].count;
        right_cost[i] = right.count ? half_area(right.box) * static_cast<double>(right.count) : infinity;
    }
    Bin left;
    int best = 0;
    double best_cost = infinity;
    for (int i = 1; i < bin_count; ++i) {
        include(left.box, bins[i - 1].box);
        left.count += bins[i - 1].count;
        const double cost =
            left.count ? half_area(left.box) * static_cast<double>(left.count) + right_cost[i] : infinity;
        if (cost < best_cost) {
            best_cost = cost;
            best = i;
        }
    }
    return best;
}

} // namespace

TrianglePoint nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    return nearest(p - a, b - a, c - a);
}

ClosestPoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const TrianglePoint found = nearest(p - a, b - a, c - a);
    return {0, found.barycentric, a + found.offset, std::sqrt(found.distance2)};
}

SearchTree::SearchTree(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    std::vector<Item> items(triangles.size());
    for (size_t t = 0; t < triangles.size(); ++t) {
        Item& item = items[t];
        for (const uint32_t v : triangles[t]) {
            item.box.include(positions[v]);
        }
        item.centre = item.box.centre();
        item.triangle = static_cast<uint32_t>(t);
    }
    nodes_.reserve(triangles.size() / 2 + 1);
    if (!items.empty()) {
        build(items, 0, 0);
    }
    order_.reserve(items.size());
    corners_.reserve(items.size());
    for (const Item& item : items) {
        const Triangle& t = triangles[item.triangle];
        order_.push_back(item.triangle);
        corners_.push_back({positions[t[0]], positions[t[1]], positions[t[2]]});
    }
    fill_leaves();
    fill_wide_nodes();
}

void SearchTree::fill_leaves() {
    const double diagonal = nodes_.empty() ? 0 : nodes_[0].box.diagonal();
    scale_ = diagonal > 0 ? 1 / diagonal : 1;
    middle_ = nodes_.empty() ? Vec3(0) : nodes_.front().box.centre();
    leaves_.resize((corners_.size() + leaf_size - 1) / leaf_size);
    leaf_boxes_.reserve(leaves_.size());
    for (size_t i = 0; i < leaves_.size(); ++i) {
        const size_t first = i * leaf_size;
        const size_t count = std::min(leaf_size, corners_.size() - first);
        Leaf& leaf = leaves_[i];
        leaf_boxes_.push_back(fitted_box(std::span<const Corners>(corners_).subspan(first, count)));
        leaf.centre = middle_ + Vec3(leaf_boxes_.back().place) / scale_;
        for (size_t lane = 0; lane < count; ++lane) {
            const Corners& t = corners_[first + lane];
            const std::array<Vec3, 3> corners{t.a, t.b, t.c};
            const FlatTriangle flat = flattened(corners, scale_);
            leaf.flat.set(lane, flat);
            const Vec3 arm = (corners[flat.origin] - leaf.centre) * scale_;
            const double reach = flat.b + std::abs(arm.x) + std::abs(arm.y) + std::abs(arm.z);
            leaf.slack = std::max(leaf.slack, flat.slack);
            leaf.reach = std::max(leaf.reach, static_cast<float>((1 + 1e-6) * reach));
            for (int axis = 0; axis < 3; ++axis) {
                leaf.origins[axis][lane] = static_cast<float>(arm[axis]);
            }
        }
    }
}

/// Across the triangles' mean normal and along the longest side.
SearchTree::LeafBox SearchTree::fitted_box(std::span<const Corners> triangles) const {
    Vec3 normal(0);
    Vec3 longest(0);
    for (const Corners& t : triangles) {
        const Vec3 ab = scale_ * (t.b - t.a);
        const Vec3 ac = scale_ * (t.c - t.a);
        normal += glm::cross(ab, ac);
        for (const Vec3& side : {ab, ac, ac - ab}) {
            longest = dot2(side) > dot2(longest) ? side : longest;
        }
    }
    // What is left of cancelled normals points anywhere, along the longest side too.
    const Vec3 z = dot2(normal) > least_square ? glm::normalize(normal) : Vec3(0, 0, 1);
    const Vec3 across = std::abs(z.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 along = longest - glm::dot(longest, z) * z;
    const bool slants = dot2(along) > std::max(1e-6 * dot2(longest), least_square);
    const Vec3 x = glm::normalize(slants ? along : glm::cross(z, across));
    LeafBox fitted;
    fitted.axes = {glm::vec3(x), glm::vec3(glm::cross(z, x)), glm::vec3(z)};
    const Vec3 origin = triangles.front().a;
    Box box;
    for (const Corners& t : triangles) {
        for (const Vec3& corner : {t.a, t.b, t.c}) {
            const Vec3 arm = scale_ * (corner - origin);
            box.include({glm::dot(Vec3(fitted.axes[0]), arm), glm::dot(Vec3(fitted.axes[1]), arm),
                         glm::dot(Vec3(fitted.axes[2]), arm)});
        }
    }
    const Vec3 middle = box.centre();
    const Vec3 centre =
        middle.x * Vec3(fitted.axes[0]) + middle.y * Vec3(fitted.axes[1]) + middle.z * Vec3(fitted.axes[2]);
    fitted.place = glm::vec3(scale_ * (origin - middle_) + centre);
    // The axes are of length one and at right angles to 2^-23 each.
    constexpr double rounding = 1e-6;
    fitted.half = glm::vec3(0.5 * (box.high - box.low) + rounding * box.diagonal());
    return fitted;
}

void SearchTree::build(std::span<Item> items, uint32_t first, int depth) {
    const size_t index = nodes_.size();
    nodes_.emplace_back();
    Box box;
    for (const Item& item : items) {
        include(box, item.box);
    }
    nodes_[index].box = box;
    if (items.size() <= leaf_size) {
        nodes_[index].first = first;
        nodes_[index].count = static_cast<uint32_t>(items.size());
        return;
    }
    const size_t middle = split(items, depth);
    build(items.first(middle), first, depth + 1);
    nodes_[index].first = static_cast<uint32_t>(nodes_.size());
    build(items.subspan(middle), first + static_cast<uint32_t>(middle), depth + 1);
}

/// Reorders the items into two parts, the first of whole leaves, neither empty; returns where the second
/// begins.
size_t SearchTree::split(std::span<Item> items, int depth) {
    Box centres;
    for (const Item& item : items) {
        centres.include(item.centre);
    }
    const Vec3 extent = centres.high - centres.low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const double scale = bin_count / extent[axis];
    const auto before = [axis](const Item& a, const Item& b) {
        return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis] : a.triangle < b.triangle;
    };
    const auto whole = [&](size_t middle) {
        return std::clamp((middle + leaf_size / 2) / leaf_size * leaf_size, leaf_size,
                          (items.size() - 1) / leaf_size * leaf_size);
    };
    if (depth < balanced_depth && std::isfinite(scale)) {
        const auto bin_of = [&](const Item& item) {
            return std::min(static_cast<int>((item.centre[axis] - centres.low[axis]) * scale), bin_count - 1);
        };
        std::array<Bin, bin_count> bins;
        for (const Item& item : items) {
            Bin& bin = bins[bin_of(item)];
            include(bin.box, item.box);
            ++bin.count;
        }
        if (const int cut = best_cut(bins)) {
            const auto second = std::partition(items.begin(), items.end(),
                                               [&](const Item& item) { return bin_of(item) < cut; });
            const size_t middle = whole(static_cast<size_t>(second - items.begin()));
            const auto wanted = items.begin() + static_cast<std::ptrdiff_t>(middle);
            const auto after = [&](const Item& a, const Item& b) { return before(b, a); };
            bring_forward(std::make_reverse_iterator(second), std::make_reverse_iterator(wanted),
                          items.rend(), after);
            bring_forward(second, wanted, items.end(), before);
            return middle;
        }
    }
    const size_t middle = whole(items.size() / 2);
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(middle), items.end(), before);
    return middle;
}

ClosestPoint SearchTree::closest(const Vec3& query, double max_distance) const {
    ClosestPoint best;
    if (nodes_.empty() || !is_finite(query) || !(max_distance >= 0)) {
        return best;
    }
    TrianglePoint nearest_found;
    nearest_found.distance2 = max_distance * max_distance;
    size_t nearest_slot = 0;
    const double unit2 = 1 / (scale_ * scale_);
    const auto offer = [&](size_t slot) {
        const Corners& t = corners_[slot];
        const TrianglePoint found = nearest(query - t.a, t.b - t.a, t.c - t.a);
        if (found.distance2 < nearest_found.distance2 ||
            (found.distance2 == nearest_found.distance2 && order_[slot] < best.triangle)) {
            nearest_found = found;
            nearest_slot = slot;
            best.triangle = order_[slot];
        }
    };
    struct Entry {
        uint32_t node;
        double distance2;
    };
    std::array<Entry, stack_size> stack;
    size_t depth = 0;
    stack[depth++] = {0, box_distance2(nodes_[0].box, query)};
    while (depth > 0) {
        const Entry entry = stack[--depth];
        if (entry.distance2 > nearest_found.distance2) {
            continue;
        }
        const Node& node = nodes_[entry.node];
        if (node.count > 0) {
            const Float4 lower = squared_distances(leaves_[node.first / leaf_size], query).low;
            for (size_t i = 0; i < node.count; ++i) {
                if (!(lower[i] * unit2 > nearest_found.distance2)) {
                    offer(node.first + i);
                }
            }
            continue;
        }
        Entry near{entry.node + 1, box_distance2(nodes_[entry.node + 1].box, query)};
        Entry far{node.first, box_distance2(nodes_[node.first].box, query)};
        if (far.distance2 < near.distance2) {
            std::swap(near, far);
        }
        stack[depth++] = far;
        stack[depth++] = near;
    }
    if (best.found()) {
        best.barycentric = nearest_found.barycentric;
        best.position = corners_[nearest_slot].a + nearest_found.offset;
        best.distance = std::sqrt(nearest_found.distance2);
    }
    return best;
}

} // namespace anvil

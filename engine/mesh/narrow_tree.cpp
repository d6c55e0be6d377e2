#include "engine/mesh/search_tree.h"

#include <cmath>

namespace anvil {

namespace {

float rounded_down(double x) {
    return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}

glm::vec3 rounded_down(const Vec3& p) {
    return {rounded_down(p.x), rounded_down(p.y), rounded_down(p.z)};
}

kernel::f32::TreeTriangle narrow_triangle(const std::array<Vec3, 3>& corners, const NarrowTree& tree) {
    const FlatTriangle flat = flattened(corners, tree.scale);
    return {tree.local(corners[flat.origin]),
            flat.x_axis,
            flat.y_axis,
            flat.b,
            flat.c.x,
            flat.c.y,
            flat.ac2_inverse,
            flat.bc2_inverse,
            flat.slack};
}

/// Inner nodes' `first`, their second child, becomes what is beyond that: for a first child that is the
/// second one, for a second child what is beyond their parent.
void find_beyond(std::vector<kernel::f32::TreeNode>& nodes) {
    const auto end = static_cast<uint32_t>(nodes.size());
    std::vector<uint32_t> beyond(nodes.size(), end);
    for (uint32_t i = 0; i < end; ++i) {
        if (nodes[i].count == 0) {
            beyond[i + 1] = nodes[i].first;
            beyond[nodes[i].first] = beyond[i];
            nodes[i].first = beyond[i];
        }
    }
}

} // namespace

NarrowTree SearchTree::narrowed() const {
    NarrowTree tree;
    if (nodes_.empty()) {
        return tree;
    }
    tree.middle = nodes_.front().box.centre();
    tree.scale = scale_;
    tree.nodes.reserve(nodes_.size());
    for (const Node& node : nodes_) {
        tree.nodes.push_back({rounded_down(tree.scale * (node.box.low - tree.middle)), node.first,
                              -rounded_down(tree.scale * (tree.middle - node.box.high)), node.count});
    }
    find_beyond(tree.nodes);
    tree.triangles.reserve(corners_.size());
    for (const auto& [a, b, c] : corners_) {
        tree.triangles.push_back(narrow_triangle({a, b, c}, tree));
    }
    return tree;
}

ClosestPoint SearchTree::closest_of(const Vec3& query, std::span<const uint32_t> slots) const {
    ClosestPoint best;
    for (const uint32_t slot : slots) {
        const auto& [a, b, c] = corners_[slot];
        const ClosestPoint there = closest_on_triangle(query, a, b, c);
        if (there.distance < best.distance ||
            (there.distance == best.distance && order_[slot] < best.triangle)) {
            best = there;
            best.triangle = order_[slot];
        }
    }
    return best;
}

} // namespace anvil

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

kernel::f32::TreeNode SearchTree::narrow_node(const Node& node) const {
    return {rounded_down(scale_ * (node.box.low - middle_)), node.first,
            -rounded_down(scale_ * (middle_ - node.box.high)), node.count};
}

void SearchTree::fill_wide_nodes() {
    if (!nodes_.empty()) {
        widen(0);
    }
}

/// What is below a node, inner ones opened from the largest on; @return the wide node.
uint32_t SearchTree::widen(uint32_t index) {
    const auto size = [&](uint32_t i) { return nodes_[i].count > 0 ? -1 : nodes_[i].box.diagonal(); };
    std::vector<uint32_t> below{index};
    while (below.size() < WideNode{}.children.size()) {
        const auto largest = std::max_element(below.begin(), below.end(),
                                              [&](uint32_t a, uint32_t b) { return size(a) < size(b); });
        const uint32_t opened = *largest;
        if (size(opened) < 0) {
            break;
        }
        *largest = opened + 1;
        below.push_back(nodes_[opened].first);
    }
    const auto wide = static_cast<uint32_t>(wide_nodes_.size());
    const glm::vec3 nowhere(std::numeric_limits<float>::infinity());
    wide_nodes_.emplace_back().children.fill({nowhere, 0, -nowhere, 1});
    for (size_t i = 0; i < below.size(); ++i) {
        kernel::f32::TreeNode child = narrow_node(nodes_[below[i]]);
        child.first = child.count > 0 ? child.first / static_cast<uint32_t>(leaf_size) : widen(below[i]);
        wide_nodes_[wide].children[i] = child;
    }
    return wide;
}

NarrowTree SearchTree::narrowed() const {
    NarrowTree tree;
    if (nodes_.empty()) {
        return tree;
    }
    tree.middle = middle_;
    tree.scale = scale_;
    tree.nodes.reserve(nodes_.size());
    for (const Node& node : nodes_) {
        tree.nodes.push_back(narrow_node(node));
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

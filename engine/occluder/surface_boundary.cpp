#include "engine/occluder/surface_boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace anvil {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr uint32_t leaf_size = 4;
constexpr double far_radii = 4.0;       // a node this many radii away counts as one piece
constexpr double least_reach = 1.0 / 8; // of the limit: less is not worth while

double distance_to(const BoundaryEdge& edge, const Vec3& p) {
    const Vec3 along = edge.to - edge.from;
    const double t = glm::dot(p - edge.from, along) / glm::dot(along, along);
    return glm::length(edge.from + std::clamp(t, 0.0, 1.0) * along - p);
}

double length_of(const BoundaryEdge& edge) {
    return edge.excess * glm::length(edge.to - edge.from);
}

} // namespace

SurfaceBoundary::SurfaceBoundary(std::vector<BoundaryEdge> edges) : edges_(std::move(edges)) {
    std::erase_if(edges_, [](const BoundaryEdge& edge) { return !(length_of(edge) > 0); });
    if (!edges_.empty()) {
        nodes_.emplace_back().count = static_cast<uint32_t>(edges_.size());
        split(0);
    }
}

void SurfaceBoundary::measure(Node& node) const {
    const std::span edges(&edges_[node.first], node.count);
    Box box;
    for (const BoundaryEdge& edge : edges) {
        box.include(edge.from);
        box.include(edge.to);
        node.length += length_of(edge);
    }
    node.centre = 0.5 * (box.low + box.high);
    for (const BoundaryEdge& edge : edges) {
        node.radius =
            std::max({node.radius, glm::length(edge.from - node.centre), glm::length(edge.to - node.centre)});
    }
}

void SurfaceBoundary::split(uint32_t parent) {
    measure(nodes_[parent]);
    const Node node = nodes_[parent];
    if (node.count <= leaf_size) {
        return;
    }
    const auto first = edges_.begin() + node.first;
    Box box;
    std::for_each(first, first + node.count, [&](const BoundaryEdge& e) { box.include(e.from + e.to); });
    const Vec3 extent = box.high - box.low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const uint32_t half = node.count / 2;
    std::nth_element(first, first + half, first + node.count,
                     [axis](const BoundaryEdge& a, const BoundaryEdge& b) {
                         return a.from[axis] + a.to[axis] < b.from[axis] + b.to[axis];
                     });
    const auto children = static_cast<uint32_t>(nodes_.size());
    nodes_[parent].children = children;
    nodes_.resize(nodes_.size() + 2);
    nodes_[children].first = node.first;
    nodes_[children].count = half;
    nodes_[children + 1].first = node.first + half;
    nodes_[children + 1].count = node.count - half;
    split(children);
    split(children + 1);
}

/// As far as 1 / (d - s) is bound by 1 / (d (1 - s / nearest)), which is exact for the nearest piece.
double SurfaceBoundary::reach(const Vec3& p, double change, double limit) const {
    if (!(change > 0)) {
        return 0;
    }
    double nearest = std::numeric_limits<double>::infinity();
    double pull = 0; // the sum of l / d^2
    const double most_pull = 4 * pi * change / (least_reach * limit);
    const auto add = [&](double length, double distance) {
        nearest = std::min(nearest, distance);
        pull += length / (distance * distance);
    };
    std::array<uint32_t, 64> stack{};
    size_t top = nodes_.empty() ? 0 : 1;
    while (top > 0) {
        const Node& node = nodes_[stack[--top]];
        const double distance = glm::length(node.centre - p);
        if (distance > far_radii * node.radius) {
            add(node.length, distance - node.radius);
        } else if (node.children != 0) {
            const auto away = [&](uint32_t child) {
                const Vec3 arm = nodes_[child].centre - p;
                return glm::dot(arm, arm);
            };
            const uint32_t second = away(node.children) < away(node.children + 1) ? 1 : 0;
            stack[top++] = node.children + second;
            stack[top++] = node.children + 1 - second;
        } else {
            for (uint32_t i = node.first; i < node.first + node.count; ++i) {
                add(length_of(edges_[i]), distance_to(edges_[i], p));
            }
        }
        if (!(pull < most_pull)) {
            return 0;
        }
    }
    return std::min(limit, 1 / (pull / (4 * pi * change) + 1 / nearest));
}

} // namespace anvil

#include "engine/occluder/winding_number.h"

#include <algorithm>
#include <cmath>

namespace anvil {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr uint32_t leaf_size = 8;
constexpr double far_reaches = 3.0; // a node this many reaches away is seen as a dipole

/// Solid angle of a triangle (van Oosterom and Strackee 1983), signed.
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    const double numerator = glm::dot(a, glm::cross(b, c));
    const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return 2 * std::atan2(numerator, denominator);
}

} // namespace

WindingNumber::WindingNumber(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    triangles_.reserve(triangles.size());
    for (const Triangle& t : triangles) {
        triangles_.push_back({positions[t[0]], positions[t[1]], positions[t[2]]});
    }
    root_.count = static_cast<uint32_t>(triangles_.size());
    measure(root_);
}

void WindingNumber::measure(Node& node) const {
    const std::span<const Corners> triangles(triangles_.data() + node.first, node.count);
    double total = 0;
    for (const auto& [a, b, c] : triangles) {
        const Vec3 area = 0.5 * glm::cross(b - a, c - a);
        const double size = glm::length(area);
        node.centre += size * (a + b + c) / 3.0;
        node.area += area;
        total += size;
    }
    if (total > 0) {
        node.centre /= total;
    } else {
        node.centre = Vec3(0);
        for (const auto& [a, b, c] : triangles) {
            node.centre += (a + b + c) / (3.0 * node.count);
        }
    }
    double reach2 = 0;
    for (const auto& [a, b, c] : triangles) {
        const Vec3 area = 0.5 * glm::cross(b - a, c - a);
        const Vec3 arm = (a + b + c) / 3.0 - node.centre;
        for (int k = 0; k < 3; ++k) {
            node.moment[k] += arm[k] * area;
        }
        for (const Vec3& corner : {a, b, c}) {
            const Vec3 to_corner = corner - node.centre;
            reach2 = std::max(reach2, glm::dot(to_corner, to_corner));
        }
    }
    node.reach = std::sqrt(reach2);
}

/// Of a node that is no leaf.
const WindingNumber::Children& WindingNumber::children(const Node& node) const {
    if (const Children* known = node.children.load(std::memory_order_acquire)) {
        return *known;
    }
    const std::lock_guard lock(growing_);
    const Children* known = node.children.load(std::memory_order_relaxed);
    return known != nullptr ? *known : split(node);
}

const WindingNumber::Children& WindingNumber::split(const Node& node) const {
    const std::span<Corners> triangles(triangles_.data() + node.first, node.count);
    Box box;
    for (const Corners& t : triangles) {
        box.include(t.a + t.b + t.c);
    }
    const Vec3 extent = box.high - box.low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const uint32_t middle = node.count / 2;
    std::nth_element(triangles.begin(), triangles.begin() + middle, triangles.end(),
                     [axis](const Corners& s, const Corners& t) {
                         return s.a[axis] + s.b[axis] + s.c[axis] < t.a[axis] + t.b[axis] + t.c[axis];
                     });
    Children& children = grown_.emplace_back();
    children[0].first = node.first;
    children[0].count = middle;
    children[1].first = node.first + middle;
    children[1].count = node.count - middle;
    for (Node& child : children) {
        measure(child);
    }
    node.children.store(&children, std::memory_order_release);
    return children;
}

double WindingNumber::far_field(const Node& node, const Vec3& arm, double distance) {
    const double cube = distance * distance * distance;
    const double trace = node.moment[0][0] + node.moment[1][1] + node.moment[2][2];
    const double along = glm::dot(arm, node.moment * arm);
    return glm::dot(arm, node.area) / cube + trace / cube - 3 * along / (cube * distance * distance);
}

double WindingNumber::at(const Vec3& p) const {
    if (triangles_.empty()) {
        return 0;
    }
    double sum = 0;
    std::array<const Node*, 64> stack;
    size_t top = 0;
    stack[top++] = &root_;
    while (top > 0) {
        const Node& node = *stack[--top];
        const Vec3 arm = node.centre - p;
        const double distance = glm::length(arm);
        if (distance > far_reaches * node.reach) {
            sum += far_field(node, arm, distance);
        } else if (node.count > leaf_size) {
            const Children& both = children(node);
            stack[top++] = &both[1];
            stack[top++] = &both[0];
        } else {
            for (uint32_t i = node.first; i < node.first + node.count; ++i) {
                sum += solid_angle(triangles_[i].a - p, triangles_[i].b - p, triangles_[i].c - p);
            }
        }
    }
    return sum / (4 * pi);
}

} // namespace anvil

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
    if (!triangles_.empty()) {
        nodes_.reserve(2 * triangles_.size() / leaf_size + 2);
        build(0, static_cast<uint32_t>(triangles_.size()));
    }
}

uint32_t WindingNumber::build(uint32_t first, uint32_t count) {
    const auto index = static_cast<uint32_t>(nodes_.size());
    nodes_.emplace_back();
    nodes_[index].first = first;
    nodes_[index].count = count;
    measure(nodes_[index]);
    if (count > leaf_size) {
        Box box;
        for (uint32_t i = first; i < first + count; ++i) {
            box.include(triangles_[i].a + triangles_[i].b + triangles_[i].c);
        }
        const Vec3 extent = box.high - box.low;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const auto begin = triangles_.begin() + first;
        std::nth_element(begin, begin + count / 2, begin + count, [axis](const Corners& s, const Corners& t) {
            return s.a[axis] + s.b[axis] + s.c[axis] < t.a[axis] + t.b[axis] + t.c[axis];
        });
        build(first, count / 2);
        const uint32_t right = build(first + count / 2, count - count / 2);
        nodes_[index].right = right;
    }
    return index;
}

void WindingNumber::measure(Node& node) const {
    double total = 0;
    Vec3 plain(0);
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
        const auto& [a, b, c] = triangles_[i];
        const Vec3 area = 0.5 * glm::cross(b - a, c - a);
        const double size = glm::length(area);
        node.centre += size * (a + b + c) / 3.0;
        plain += (a + b + c) / (3.0 * node.count);
        node.area += area;
        total += size;
    }
    node.centre = total > 0 ? node.centre / total : plain;
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
        const auto& [a, b, c] = triangles_[i];
        const Vec3 area = 0.5 * glm::cross(b - a, c - a);
        const Vec3 arm = (a + b + c) / 3.0 - node.centre;
        for (int k = 0; k < 3; ++k) {
            node.moment[k] += arm[k] * area;
            const Vec3& corner = k == 0 ? a : k == 1 ? b : c;
            node.reach = std::max(node.reach, glm::length(corner - node.centre));
        }
    }
}

double WindingNumber::far_field(const Node& node, const Vec3& arm, double distance) {
    const double cube = distance * distance * distance;
    const double trace = node.moment[0][0] + node.moment[1][1] + node.moment[2][2];
    const double along = glm::dot(arm, node.moment * arm);
    return glm::dot(arm, node.area) / cube + trace / cube - 3 * along / (cube * distance * distance);
}

double WindingNumber::at(const Vec3& p) const {
    if (nodes_.empty()) {
        return 0;
    }
    double sum = 0;
    uint32_t stack[64];
    size_t top = 0;
    stack[top++] = 0;
    while (top > 0) {
        const uint32_t index = stack[--top];
        const Node& node = nodes_[index];
        const Vec3 arm = node.centre - p;
        const double distance = glm::length(arm);
        if (distance > far_reaches * node.reach) {
            sum += far_field(node, arm, distance);
        } else if (node.right != 0) {
            stack[top++] = node.right;
            stack[top++] = index + 1;
        } else {
            for (uint32_t i = node.first; i < node.first + node.count; ++i) {
                sum += solid_angle(triangles_[i].a - p, triangles_[i].b - p, triangles_[i].c - p);
            }
        }
    }
    return sum / (4 * pi);
}

} // namespace anvil

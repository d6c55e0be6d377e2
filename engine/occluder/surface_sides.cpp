#include "engine/occluder/surface_sides.h"

#include "engine/mesh/weld.h"

#include <cmath>

namespace anvil {

namespace {

/// A triangle's edge from corner `edge % 3` on, of triangle edge / 3.
struct EdgeUse {
    uint64_t key; ///< of the two vertices, whatever the direction
    uint32_t edge;
    bool forward;
};

constexpr double clearly = 1e-6; // sine of the least angle to the surface that tells the side

double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

} // namespace

SurfaceSides::SurfaceSides(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                           const SearchTree& tree, const WindingNumber& winding)
    : positions_(positions.begin(), positions.end()), triangles_(triangles.begin(), triangles.end()),
      sound_(triangles.size(), true), front_(triangles.size(), unknown) {
    const std::vector<uint32_t> lowest = first_equal(positions);
    normals_.reserve(triangles.size());
    for (Triangle& t : triangles_) {
        t = {lowest[t[0]], lowest[t[1]], lowest[t[2]]};
        const Vec3 area = glm::cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
        const double size = glm::length(area);
        normals_.push_back(size > 0 ? area / size : Vec3(0));
    }
    const std::vector<Crossing> crossings = find_crossings(positions, triangles_, tree);
    for (size_t t = 0; t < triangles_.size(); ++t) {
        sound_[t] = crossings[t] == Crossing::none && normals_[t] != Vec3(0);
        crossing_ += crossings[t] == Crossing::crosses ? 1 : 0;
    }
    join_edges();
    if (closed_) {
        find_components(winding);
        find_vertex_normals();
    }
}

void SurfaceSides::join_edges() {
    std::vector<EdgeUse> uses;
    uses.reserve(3 * triangles_.size());
    for (uint32_t t = 0; t < triangles_.size(); ++t) {
        for (uint32_t i = 0; i < 3; ++i) {
            const uint64_t a = triangles_[t][i];
            const uint64_t b = triangles_[t][(i + 1) % 3];
            if (a != b) {
                uses.push_back({std::min(a, b) << 32 | std::max(a, b), 3 * t + i, a < b});
            }
        }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return a.key != b.key ? a.key < b.key : a.edge < b.edge;
    });
    neighbours_.assign(3 * triangles_.size(), no_index);
    for (size_t i = 0; i < uses.size();) {
        size_t end = i;
        size_t forward = 0;
        for (; end < uses.size() && uses[end].key == uses[i].key; ++end) {
            forward += uses[end].forward ? 1 : 0;
        }
        closed_ = closed_ && 2 * forward == end - i;
        if (end - i == 2 && forward == 1) {
            neighbours_[uses[i].edge] = uses[i + 1].edge / 3;
            neighbours_[uses[i + 1].edge] = uses[i].edge / 3;
        }
        i = end;
    }
}

void SurfaceSides::find_components(const WindingNumber& winding) {
    std::vector<bool> seen(triangles_.size(), false);
    for (uint32_t start = 0; start < triangles_.size(); ++start) {
        if (seen[start] || !sound_[start]) {
            continue;
        }
        std::vector<uint32_t> component{start};
        seen[start] = true;
        for (size_t next = 0; next < component.size(); ++next) {
            for (int i = 0; i < 3; ++i) {
                const uint32_t other = neighbours_[3 * component[next] + i];
                if (other != no_index && sound_[other] && !seen[other]) {
                    seen[other] = true;
                    component.push_back(other);
                }
            }
        }
        const int front = measured_front(component, winding);
        for (const uint32_t t : component) {
            front_[t] = front;
        }
    }
}

/// Measured on both sides of three faces, the largest among them; unknown unless all agree.
int SurfaceSides::measured_front(const std::vector<uint32_t>& component, const WindingNumber& winding) const {
    const auto area = [&](uint32_t t) {
        const auto& [a, b, c] = triangles_[t];
        return glm::length(glm::cross(positions_[b] - positions_[a], positions_[c] - positions_[a]));
    };
    const uint32_t largest = *std::max_element(component.begin(), component.end(),
                                               [&](uint32_t a, uint32_t b) { return area(a) < area(b); });
    int front = unknown;
    for (const uint32_t t : {largest, component.front(), component[component.size() / 2]}) {
        const auto& [a, b, c] = triangles_[t];
        const Vec3 centre = (positions_[a] + positions_[b] + positions_[c]) / 3.0;
        const Vec3 step = 1e-4 * std::sqrt(area(t)) * normals_[t];
        const double before = winding.at(centre + step);
        const double behind = winding.at(centre - step);
        const auto whole = static_cast<int>(std::lround(before));
        const bool certain = std::abs(before - whole) < 0.1 && std::abs(behind - whole - 1) < 0.1;
        if (!certain || (front != unknown && front != whole)) {
            return unknown;
        }
        front = whole;
    }
    return front;
}

/// Angle-weighted; only where the vertex has one whole fan of sound triangles.
void SurfaceSides::find_vertex_normals() {
    vertex_normals_.assign(positions_.size(), Vec3(0));
    std::vector<uint32_t> counts(positions_.size(), 0);
    std::vector<uint32_t> firsts(positions_.size(), no_index);
    std::vector<bool> sound(positions_.size(), true);
    for (uint32_t t = 0; t < triangles_.size(); ++t) {
        for (int i = 0; i < 3; ++i) {
            const uint32_t v = triangles_[t][i];
            const Vec3 to_next = positions_[triangles_[t][(i + 1) % 3]] - positions_[v];
            const Vec3 to_last = positions_[triangles_[t][(i + 2) % 3]] - positions_[v];
            vertex_normals_[v] += angle_between(to_next, to_last) * normals_[t];
            ++counts[v];
            firsts[v] = t;
            sound[v] = sound[v] && sound_[t];
        }
    }
    for (uint32_t v = 0; v < positions_.size(); ++v) {
        if (counts[v] > 0 && !(sound[v] && fan_is_whole(firsts[v], v, counts[v]))) {
            vertex_normals_[v] = Vec3(0);
        }
    }
}

bool SurfaceSides::fan_is_whole(uint32_t first_triangle, uint32_t vertex, size_t count) const {
    uint32_t t = first_triangle;
    for (size_t turned = 1;; ++turned) {
        uint32_t i = 0;
        while (triangles_[t][i] != vertex) {
            ++i;
        }
        t = neighbours_[3 * t + i];
        if (t == no_index || turned > count) {
            return false;
        }
        if (t == first_triangle) {
            return turned == count;
        }
    }
}

std::optional<Vec3> SurfaceSides::normal_at(const ClosestPoint& closest) const {
    const uint32_t t = closest.triangle;
    int zeros = 0;
    int corner = 0; // one with weight
    int free = 0;   // one without
    for (int i = 0; i < 3; ++i) {
        if (closest.barycentric[i] == 0) {
            ++zeros;
            free = i;
        } else {
            corner = i;
        }
    }
    if (zeros == 0) {
        return normals_[t];
    }
    if (zeros == 2) {
        const Vec3& normal = vertex_normals_[triangles_[t][corner]];
        return normal != Vec3(0) ? std::optional(normal) : std::nullopt;
    }
    const uint32_t other = neighbours_[3 * t + (free + 1) % 3];
    return other != no_index && sound_[other] ? std::optional(normals_[t] + normals_[other]) : std::nullopt;
}

std::optional<int> SurfaceSides::winding(const Vec3& p, const ClosestPoint& closest) const {
    if (front_[closest.triangle] == unknown) {
        return std::nullopt;
    }
    const std::optional<Vec3> normal = normal_at(closest);
    if (!normal) {
        return std::nullopt;
    }
    const Vec3 arm = p - closest.position;
    const double height = glm::dot(arm, *normal);
    if (!(std::abs(height) > clearly * glm::length(arm) * glm::length(*normal))) {
        return std::nullopt;
    }
    return front_[closest.triangle] + (height < 0 ? 1 : 0);
}

} // namespace anvil

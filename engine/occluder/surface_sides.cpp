#include "engine/occluder/surface_sides.h"

#include "engine/mesh/weld.h"

#include <cmath>
#include <numeric>

namespace anvil {

namespace {

/// A triangle's edge from corner `edge % 3` on, of triangle edge / 3.
struct EdgeUse {
    uint32_t high; ///< of its two vertices
    uint32_t edge;
    bool forward; ///< from the lower one to that
};

constexpr double clearly = 1e-6; // sine of the least angle to the surface that tells the side

double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

} // namespace

SurfaceSides::SurfaceSides(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                           const SearchTree& tree, const WindingNumber& winding)
    : slots_(triangles.size()) {
    const std::vector<uint32_t> lowest = first_equal(positions);
    std::vector<Triangle> joined;
    joined.reserve(triangles.size());
    for (const Triangle& t : triangles) {
        joined.push_back({lowest[t[0]], lowest[t[1]], lowest[t[2]]});
    }
    const std::vector<Crossing> crossings = find_crossings(positions, joined, tree);
    std::vector<uint32_t> numbers(positions.size(), no_index);
    faces_.reserve(triangles.size());
    for (const uint32_t t : tree.order()) {
        slots_[t] = static_cast<uint32_t>(faces_.size());
        add_face(joined[t], positions, numbers, crossings[t]);
    }
    join_edges();
    if (closed_) {
        find_components(winding);
        find_vertex_normals();
    }
}

void SurfaceSides::add_face(const Triangle& t, std::span<const Vec3> positions,
                            std::vector<uint32_t>& numbers, Crossing crossing) {
    Face& face = faces_.emplace_back();
    for (int i = 0; i < 3; ++i) {
        uint32_t& number = numbers[t[i]];
        if (number == no_index) {
            number = static_cast<uint32_t>(positions_.size());
            positions_.push_back(positions[t[i]]);
        }
        face.corners[i] = number;
    }
    const Vec3 area = glm::cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
    const double size = glm::length(area);
    face.normal = size > 0 ? area / size : Vec3(0);
    face.sound = crossing == Crossing::none && face.normal != Vec3(0);
    crossing_ += crossing == Crossing::crosses ? 1 : 0;
}

template <class Visit>
void SurfaceSides::each_edge(const Visit& visit) const {
    for (uint32_t t = 0; t < faces_.size(); ++t) {
        for (uint32_t i = 0; i < 3; ++i) {
            const uint32_t from = faces_[t].corners[i];
            const uint32_t to = faces_[t].corners[(i + 1) % 3];
            if (from != to) {
                visit(std::min(from, to), EdgeUse{std::max(from, to), 3 * t + i, from < to});
            }
        }
    }
}

void SurfaceSides::join_edges() {
    // Where each lower vertex' uses end, once they are filled in.
    std::vector<uint32_t> end(positions_.size() + 1, 0);
    each_edge([&](uint32_t low, const EdgeUse&) { ++end[low + 1]; });
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<EdgeUse> uses(end.back());
    each_edge([&](uint32_t low, const EdgeUse& use) { uses[end[low]++] = use; });
    const auto before = [](const EdgeUse& a, const EdgeUse& b) {
        return a.high != b.high ? a.high < b.high : a.edge < b.edge;
    };
    size_t begin = 0;
    for (size_t low = 0; low < positions_.size(); ++low) {
        std::sort(uses.begin() + static_cast<std::ptrdiff_t>(begin), uses.begin() + end[low], before);
        for (size_t last = begin; begin < end[low]; begin = last) {
            size_t forward = 0;
            for (; last < end[low] && uses[last].high == uses[begin].high; ++last) {
                forward += uses[last].forward ? 1 : 0;
            }
            if (const size_t backward = last - begin - forward; forward != backward) {
                closed_ = false;
                boundary_.push_back({positions_[low], positions_[uses[begin].high],
                                     std::abs(static_cast<double>(forward) - static_cast<double>(backward))});
            }
            tangled_ = tangled_ || last - begin > 2 || (last - begin == 2 && forward != 1);
            if (last - begin == 2 && forward == 1) {
                join(uses[begin].edge, uses[begin + 1].edge);
            }
        }
    }
}

void SurfaceSides::join(uint32_t edge, uint32_t other) {
    faces_[edge / 3].neighbours[edge % 3] = other / 3;
    faces_[other / 3].neighbours[other % 3] = edge / 3;
}

void SurfaceSides::find_components(const WindingNumber& winding) {
    std::vector<bool> seen(faces_.size(), false);
    for (const uint32_t start : slots_) {
        if (seen[start] || !faces_[start].sound) {
            continue;
        }
        std::vector<uint32_t> component{start};
        seen[start] = true;
        for (size_t next = 0; next < component.size(); ++next) {
            for (const uint32_t other : faces_[component[next]].neighbours) {
                if (other != no_index && faces_[other].sound && !seen[other]) {
                    seen[other] = true;
                    component.push_back(other);
                }
            }
        }
        const int front = measured_front(component, winding);
        for (const uint32_t t : component) {
            faces_[t].front = front;
        }
    }
}

/// Measured on both sides of three faces, the largest among them; unknown unless all agree.
int SurfaceSides::measured_front(const std::vector<uint32_t>& component, const WindingNumber& winding) const {
    const auto area = [&](uint32_t t) {
        const auto& [a, b, c] = faces_[t].corners;
        return glm::length(glm::cross(positions_[b] - positions_[a], positions_[c] - positions_[a]));
    };
    const uint32_t largest = *std::max_element(component.begin(), component.end(),
                                               [&](uint32_t a, uint32_t b) { return area(a) < area(b); });
    int front = unknown;
    for (const uint32_t t : {largest, component.front(), component[component.size() / 2]}) {
        const auto& [a, b, c] = faces_[t].corners;
        const Vec3 centre = (positions_[a] + positions_[b] + positions_[c]) / 3.0;
        const Vec3 step = 1e-4 * std::sqrt(area(t)) * faces_[t].normal;
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
    for (uint32_t t = 0; t < faces_.size(); ++t) {
        const Face& face = faces_[t];
        for (int i = 0; i < 3; ++i) {
            const uint32_t v = face.corners[i];
            const Vec3 to_next = positions_[face.corners[(i + 1) % 3]] - positions_[v];
            const Vec3 to_last = positions_[face.corners[(i + 2) % 3]] - positions_[v];
            vertex_normals_[v] += angle_between(to_next, to_last) * face.normal;
            ++counts[v];
            firsts[v] = t;
            sound[v] = sound[v] && face.sound;
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
        while (faces_[t].corners[i] != vertex) {
            ++i;
        }
        t = faces_[t].neighbours[i];
        if (t == no_index || turned > count) {
            return false;
        }
        if (t == first_triangle) {
            return turned == count;
        }
    }
}

std::optional<Vec3> SurfaceSides::normal_at(const Face& face, const Vec3& barycentric) const {
    int zeros = 0;
    int corner = 0; // one with weight
    int free = 0;   // one without
    for (int i = 0; i < 3; ++i) {
        if (barycentric[i] == 0) {
            ++zeros;
            free = i;
        } else {
            corner = i;
        }
    }
    if (zeros == 0) {
        return face.normal;
    }
    if (zeros == 2) {
        const Vec3& normal = vertex_normals_[face.corners[corner]];
        return normal != Vec3(0) ? std::optional(normal) : std::nullopt;
    }
    const uint32_t other = face.neighbours[(free + 1) % 3];
    return other != no_index && faces_[other].sound ? std::optional(face.normal + faces_[other].normal)
                                                    : std::nullopt;
}

std::optional<int> SurfaceSides::winding(const Vec3& p, const ClosestPoint& closest) const {
    const Face& face = faces_[slots_[closest.triangle]];
    if (face.front == unknown) {
        return std::nullopt;
    }
    const std::optional<Vec3> normal = normal_at(face, closest.barycentric);
    if (!normal) {
        return std::nullopt;
    }
    const Vec3 arm = p - closest.position;
    const double height = glm::dot(arm, *normal);
    if (!(std::abs(height) > clearly * glm::length(arm) * glm::length(*normal))) {
        return std::nullopt;
    }
    return face.front + (height < 0 ? 1 : 0);
}

} // namespace anvil

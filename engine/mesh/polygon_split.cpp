#include "engine/mesh/polygon_split.h"

#include "engine/mesh/scale.h"

#include <numeric>

namespace anvil {

namespace {

// Differences below this (of a unit polygon) are rounding of the file's float numbers squared, not shape.
constexpr double tie = 1e-9;
// Up to this many corners the best-shaped ear is looked for; beyond, the first one is taken.
constexpr size_t small_polygon = 32;

/// 1 - cosine of the fold between two triangles; above 2 where one has no area.
double fold(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 first = glm::cross(b - a, c - a);
    const Vec3 second = glm::cross(c - a, d - a);
    const double lengths = glm::length(first) * glm::length(second);
    return lengths > tie * tie ? 1 - glm::dot(first, second) / lengths : 3;
}

} // namespace

const std::vector<Triangle>& PolygonSplitter::split(const std::vector<Vec3>& points) {
    triangles_.clear();
    if (points.size() == 3) {
        triangles_.push_back({0, 1, 2});
        return triangles_;
    }
    double longest = 0;
    points_.resize(points.size());
    for (size_t i = 0; i < points.size(); ++i) {
        points_[i] = points[i] - points[0];
        longest = std::max({longest, std::abs(points_[i].x), std::abs(points_[i].y), std::abs(points_[i].z)});
    }
    const double scale = unit_scale(longest);
    for (Vec3& p : points_) {
        p *= scale;
    }
    if (points.size() == 4) {
        split_quad();
    } else {
        split_large();
    }
    return triangles_;
}

void PolygonSplitter::split_quad() {
    const std::vector<Vec3>& p = points_;
    const double across_02 = fold(p[0], p[1], p[2], p[3]);
    const double across_13 = fold(p[1], p[2], p[3], p[0]);
    bool take_13 = across_13 < across_02;
    if (std::abs(across_13 - across_02) <= tie) {
        take_13 = glm::length(p[3] - p[1]) < (1 - tie) * glm::length(p[2] - p[0]);
    }
    if (take_13) {
        triangles_ = {{0, 1, 3}, {1, 2, 3}};
    } else {
        triangles_ = {{0, 1, 2}, {0, 2, 3}};
    }
}

void PolygonSplitter::split_large() {
    project();
    const auto n = static_cast<uint32_t>(points_.size());
    if (!strictly_convex()) {
        clip_ears();
        return;
    }
    for (uint32_t i = 1; i + 1 < n; ++i) {
        triangles_.push_back({0, i, i + 1});
    }
}

void PolygonSplitter::project() {
    Vec3 normal{0};
    for (size_t i = 1; i + 1 < points_.size(); ++i) {
        normal += glm::cross(points_[i], points_[i + 1]);
    }
    const double length = glm::length(normal);
    normal = length > 0 ? normal / length : Vec3{0, 0, 1};
    const Vec3 side = std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 u = glm::normalize(glm::cross(side, normal));
    const Vec3 v = glm::cross(normal, u);
    flat_.resize(points_.size());
    for (size_t i = 0; i < points_.size(); ++i) {
        flat_[i] = {glm::dot(points_[i], u), glm::dot(points_[i], v)};
    }
}

double PolygonSplitter::turn(uint32_t a, uint32_t b, uint32_t c) const {
    const glm::dvec2 ab = flat_[b] - flat_[a];
    const glm::dvec2 ac = flat_[c] - flat_[a];
    return ab.x * ac.y - ab.y * ac.x;
}

bool PolygonSplitter::strictly_convex() const {
    const auto n = static_cast<uint32_t>(flat_.size());
    // A star turns left everywhere too, but its fan has triangles that turn right.
    for (uint32_t i = 0; i < n; ++i) {
        const bool in_fan = i > 0 && i + 1 < n;
        if (turn(i, (i + 1) % n, (i + 2) % n) <= tie || (in_fan && turn(0, i, i + 1) <= tie)) {
            return false;
        }
    }
    return true;
}

bool PolygonSplitter::is_ear(size_t slot) {
    const size_t n = remaining_.size();
    const uint32_t a = remaining_[(slot + n - 1) % n];
    const uint32_t b = remaining_[slot];
    const uint32_t c = remaining_[(slot + 1) % n];
    if (turn(a, b, c) <= tie) {
        return false;
    }
    budget_ -= static_cast<double>(n);
    for (const uint32_t p : remaining_) {
        const bool corner = flat_[p] == flat_[a] || flat_[p] == flat_[b] || flat_[p] == flat_[c];
        if (!corner && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) {
            return false;
        }
    }
    return true;
}

size_t PolygonSplitter::choose_ear(size_t start) {
    const size_t n = remaining_.size();
    size_t best = n;
    double best_shape = 0;
    for (size_t i = 0; i < n && budget_ > 0; ++i) {
        const size_t slot = (start + i) % n;
        if (!is_ear(slot)) {
            continue;
        }
        if (n > small_polygon) {
            return slot;
        }
        const uint32_t a = remaining_[(slot + n - 1) % n];
        const uint32_t c = remaining_[(slot + 1) % n];
        const glm::dvec2 chord = flat_[c] - flat_[a];
        const double shape = turn(a, remaining_[slot], c) / glm::dot(chord, chord);
        if (shape > best_shape) {
            best = slot;
            best_shape = shape;
        }
    }
    return best;
}

void PolygonSplitter::clip_ears() {
    remaining_.resize(points_.size());
    std::iota(remaining_.begin(), remaining_.end(), 0U);
    size_t start = 1;
    for (size_t n = remaining_.size(); n > 3; --n) {
        const size_t found = choose_ear(start);
        // Self-crossing polygons and spent budgets have no ear: fan on, so that there are always n - 2
        // triangles.
        const size_t slot = found < n ? found : n - 1;
        triangles_.push_back({remaining_[(slot + n - 1) % n], remaining_[slot], remaining_[(slot + 1) % n]});
        remaining_.erase(remaining_.begin() + static_cast<std::ptrdiff_t>(slot));
        start = slot % remaining_.size();
    }
    triangles_.push_back({remaining_[0], remaining_[1], remaining_[2]});
}

} // namespace anvil

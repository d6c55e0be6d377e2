#include "app/viewer/recorded_path.h"

#include <algorithm>

namespace anvil {

namespace {

double apart(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 way = b - a;
    const double length = glm::dot(way, way);
    const double s = length > 0 ? std::clamp(glm::dot(p - a, way) / length, 0.0, 1.0) : 0;
    return glm::length(p - a - s * way);
}

void keep_between(std::span<const Vec3> offsets, size_t first, size_t last, double tolerance,
                  std::vector<bool>& kept) {
    size_t worst = first;
    double most = tolerance;
    for (size_t i = first + 1; i < last; ++i) {
        const double off = apart(offsets[i], offsets[first], offsets[last]);
        if (off > most) {
            most = off;
            worst = i;
        }
    }
    if (worst != first) {
        kept[worst] = true;
        keep_between(offsets, first, worst, tolerance, kept);
        keep_between(offsets, worst, last, tolerance, kept);
    }
}

} // namespace

std::vector<Vec3> thinned_path(std::span<const Vec3> offsets, double tolerance) {
    const bool leaves = std::any_of(offsets.begin(), offsets.end(),
                                    [&](const Vec3& offset) { return offset != offsets.front(); });
    if (!leaves) {
        return {};
    }
    std::vector<bool> kept(offsets.size(), false);
    kept.front() = kept.back() = true;
    keep_between(offsets, 0, offsets.size() - 1, tolerance, kept);
    std::vector<Vec3> path;
    for (size_t i = 0; i < offsets.size(); ++i) {
        if (kept[i]) {
            path.push_back(offsets[i]);
        }
    }
    return path;
}

} // namespace anvil

#include "engine/refine/handle_field.h"

#include "engine/distance/anchor_blend.h"

namespace anvil {

namespace {

// Slopes that differ by less, relative to the steepest, are rounding of the same slope.
constexpr double slope_rounding = 1e-9;

double slope_at_end(const ShapeSegmentD& p, double end) {
    const double s = end - p.begin;
    return p.c1 + s * (2 * p.c2 + s * 3 * p.c3);
}

} // namespace

double HandleField::blended(std::span<const double> distances) const {
    return distances.size() == 1 ? distances.front() : smooth_minimum(distances, blend);
}

double HandleField::distance(uint32_t vertex) const {
    if (anchors.size() == 1) {
        return anchors.front().distances[vertex];
    }
    std::vector<double> each;
    each.reserve(anchors.size());
    for (const AnchorField& anchor : anchors) {
        each.push_back(anchor.distances[vertex]);
    }
    return each.empty() ? infinity : blended(each);
}

std::vector<ShapeLevel> shape_levels(const HandleField& handle) {
    const auto& segments = handle.shape.segments();
    const double steepest = handle.shape.lipschitz();
    std::vector<ShapeLevel> levels;
    for (size_t i = 0; i < segments.size(); ++i) {
        const bool last = i + 1 == segments.size();
        const double end = last ? 1 : segments[i + 1].begin;
        const double after = last ? 0 : segments[i + 1].c1;
        const double jump = std::abs(slope_at_end(segments[i], end) - after);
        if (end > segments[i].begin) {
            levels.push_back({handle.radius * end, jump > slope_rounding * steepest});
        }
    }
    return levels;
}

} // namespace anvil

#include "engine/distance/segment_seeds.h"

#include "engine/core/error.h"

#include <optional>

namespace anvil {
namespace {

/// Closest point of the segment, if it lies between its ends.
std::optional<PlanePoint> foot(const Segment& segment, const PlanePoint& from) {
    const double dx = segment.to.x - segment.from.x, dy = segment.to.y - segment.from.y;
    const double t = ((from.x - segment.from.x) * dx + (from.y - segment.from.y) * dy) / (dx * dx + dy * dy);
    if (!(t > 0 && t < 1)) {
        return std::nullopt;
    }
    return PlanePoint{segment.from.x + t * dx, segment.from.y + t * dy};
}

void seed_segment(const TriangleGraph& graph, const Segment& segment, uint32_t label,
                  std::vector<Seed>& seeds) {
    const std::array<PlanePoint, 3> corners = laid_out(graph, segment.base);
    std::array<PlanePoint, 3> feet = corners;
    std::array<bool, 3> seen{};
    for (size_t k = 0; k < 3; ++k) {
        const std::optional<PlanePoint> at = foot(segment, corners[k]);
        seen[k] = at.has_value();
        feet[k] = at.value_or(corners[k]);
    }
    std::vector<Seed> all;
    Seed like;
    like.label = label;
    like.of_line = true;
    seed_corners(graph, segment.base, feet, like, all);
    for (size_t k = 0; k < 3; ++k) {
        // A corner on the segment is a point of the polyline, or comes from its end.
        if (seen[k] && all[k].distance > 0) {
            seeds.push_back(all[k]);
        }
    }
}

void add_segment(const TriangleGraph& graph, const PlacedPoint& a, const PlacedPoint& b, uint32_t label,
                 const std::string& name, SourceParts& parts) {
    bool found = false;
    for (const uint32_t base : triangles_with(graph, a)) {
        const std::optional<PlanePoint> from = place_in(graph, a, base), to = place_in(graph, b, base);
        if (!from || !to) {
            continue;
        }
        const Segment segment{base, *from, *to};
        if (std::hypot(to->x - from->x, to->y - from->y) > 0) {
            seed_segment(graph, segment, label, parts.seeds);
            // Along an edge several triangles hold it; one sends its rays to all.
            if (!found) {
                parts.segments.push_back(segment);
            }
        }
        found = true;
    }
    if (!found) {
        throw InputError(name +
                         ": two points that follow each other lie in no common triangle; add the points "
                         "where the line crosses edges");
    }
}

} // namespace

SourceParts source_parts(const TriangleGraph& graph, std::span<const SurfacePoint> points,
                         std::span<const std::vector<SurfacePoint>> polylines,
                         std::span<const uint32_t> triangles) {
    SourceParts parts;
    uint32_t label = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        seed_point(graph, placed(graph, points[i], "source", i), label++, parts.seeds);
    }
    for (size_t i = 0; i < polylines.size(); ++i) {
        std::vector<PlacedPoint> line;
        for (const SurfacePoint& point : polylines[i]) {
            line.push_back(placed(graph, point, "polyline", i));
            seed_point(graph, line.back(), label, parts.seeds);
        }
        for (size_t k = 1; k < line.size(); ++k) {
            add_segment(graph, line[k - 1], line[k], label, "distance polyline " + std::to_string(i), parts);
        }
        ++label;
    }
    for (size_t i = 0; i < triangles.size(); ++i, ++label) {
        std::array<PlacedPoint, 3> corners;
        for (int k = 0; k < 3; ++k) {
            Vec3 weights(0);
            weights[k] = 1;
            corners[k] = placed(graph, {triangles[i], weights, no_index}, "face", i);
            seed_point(graph, corners[k], label, parts.seeds);
        }
        for (int k = 0; k < 3; ++k) {
            add_segment(graph, corners[k], corners[(k + 1) % 3], label, "distance face " + std::to_string(i),
                        parts);
        }
    }
    return parts;
}

} // namespace anvil

#include "engine/forge/anchor_set.h"

#include <algorithm>

namespace anvil {

namespace {

/// An anchor by its own points: two of a kind at the same points are one.
struct ResolvedAnchor {
    std::vector<SurfacePoint> points; ///< one, or those that a polyline names
    std::vector<uint32_t> triangles;
};

ResolvedAnchor resolve(const AnchorAddress& anchor, const std::string& place, SurfaceState& surface) {
    ResolvedAnchor result;
    if (const auto* face = std::get_if<WholeFaceAddress>(&anchor)) {
        result.triangles = surface.triangles_of(*face, place);
        return result;
    }
    const auto* line = std::get_if<PolylineAddress>(&anchor);
    if (!line) {
        result.points.push_back(surface.resolve(std::get<SurfaceAddress>(anchor), place));
        return result;
    }
    for (size_t i = 0; i < line->points.size(); ++i) {
        result.points.push_back(
            surface.resolve(line->points[i], place + ".polyline[" + std::to_string(i) + "]"));
    }
    return result;
}

bool same_anchor(const ResolvedAnchor& a, const ResolvedAnchor& b, const SurfaceState& surface) {
    const auto same = [&](const SurfacePoint& p, const SurfacePoint& q) { return surface.same_place(p, q); };
    return a.triangles == b.triangles &&
           (std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), same) ||
            std::equal(a.points.begin(), a.points.end(), b.points.rbegin(), b.points.rend(), same));
}

} // namespace

std::vector<DistanceSources> resolve_anchors(const std::vector<AnchorAddress>& anchors,
                                             uint32_t smooth_rounds, const std::string& place,
                                             SurfaceState& surface) {
    std::vector<ResolvedAnchor> known;
    std::vector<DistanceSources> result;
    for (size_t i = 0; i < anchors.size(); ++i) {
        const std::string where = place + ".at[" + std::to_string(i) + "]";
        ResolvedAnchor anchor = resolve(anchors[i], where, surface);
        if (std::any_of(known.begin(), known.end(),
                        [&](const ResolvedAnchor& k) { return same_anchor(k, anchor, surface); })) {
            continue;
        }
        known.push_back(anchor);
        result.emplace_back();
        result.back().triangles = std::move(anchor.triangles);
        if (std::holds_alternative<PolylineAddress>(anchors[i])) {
            result.back().polylines = {
                surface.line_through(anchor.points, smooth_rounds, where + ".polyline")};
        } else {
            result.back().points = std::move(anchor.points);
        }
    }
    return result;
}

} // namespace anvil

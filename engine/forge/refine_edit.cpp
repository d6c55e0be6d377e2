#include "engine/forge/refine_edit.h"

#include "engine/distance/anchor_blend.h"

#include <algorithm>

namespace anvil {

namespace {

constexpr size_t default_limit = 1'000'000;

/// Points of the anchors of all kinds; of faces the corners.
std::vector<Vec3> places_of(const std::vector<DistanceSources>& anchors, const Mesh& mesh,
                            std::span<const Vec3> positions, const SurfaceState& surface) {
    std::vector<Vec3> places;
    for (const DistanceSources& anchor : anchors) {
        for (const SurfacePoint& point : anchor.points) {
            places.push_back(surface.position_of(point));
        }
        for (const auto& line : anchor.polylines) {
            for (const SurfacePoint& point : line) {
                places.push_back(surface.position_of(point));
            }
        }
        for (const uint32_t t : anchor.triangles) {
            for (const uint32_t corner : mesh.triangles[t]) {
                places.push_back(positions[corner]);
            }
        }
    }
    return places;
}

AnchorField field_of(const DistanceSources& anchor, DistanceQuery query, double reach, size_t vertex_count,
                     SurfaceState& surface) {
    query.anchors = {anchor};
    query.radius = reach;
    AnchorField field;
    field.distances = surface.distances({&query, 1})[0].dense(vertex_count);
    if (anchor.points.empty()) {
        field.kind = SourceKind::line;
    } else if (query.metric == Metric::euclidean) {
        field.straight_from = surface.position_of(anchor.points[0]);
    }
    return field;
}

/// atan2 keeps its digits at angles near 0, where acos has none.
double angle_at(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::atan2(glm::length(glm::cross(b - a, c - a)), glm::dot(b - a, c - a));
}

} // namespace

std::vector<SurfacePoint> points_of(const Edit& edit, const std::string& place, SurfaceState& surface) {
    std::vector<SurfacePoint> points;
    for (size_t j = 0; j < edit.handles.size(); ++j) {
        points.push_back(
            surface.resolve(edit.handles[j].at, place + ".handles[" + std::to_string(j) + "].at"));
        for (const DistanceSources& anchor : query_of(edit, j, points.back(), place, surface).anchors) {
            points.insert(points.end(), anchor.points.begin(), anchor.points.end());
            for (const auto& line : anchor.polylines) {
                points.insert(points.end(), line.begin(), line.end());
            }
        }
    }
    for (size_t i = 0; i < edit.pinned.size(); ++i) {
        points.push_back(surface.resolve(edit.pinned[i], place + ".pinned[" + std::to_string(i) + "]"));
    }
    return points;
}

RefineState start_refinement(const Edit& edit, const EditRegion& region, const std::string& place,
                             const Mesh& mesh, std::span<const Vec3> positions, SurfaceState& surface) {
    RefineState state{{positions.begin(), positions.end()}, {}, {}};
    for (size_t j = 0; j < edit.handles.size(); ++j) {
        const SurfacePoint handle =
            surface.resolve(edit.handles[j].at, place + ".handles[" + std::to_string(j) + "].at");
        const DistanceQuery query = query_of(edit, j, handle, place, surface);
        const std::vector<Vec3> places = places_of(query.anchors, mesh, positions, surface);
        const double reach = blend_reach(needed_reach(mesh.triangles, positions, places, region.radii[j]),
                                         query.blend_width, query.anchors.size());
        HandleField field{region.shapes[j], region.radii[j], query.blend_width, {}};
        for (const DistanceSources& anchor : query.anchors) {
            field.anchors.push_back(field_of(anchor, query, reach, positions.size(), surface));
        }
        state.handles.push_back(std::move(field));
    }
    return state;
}

EditRegion region_after(const EditRegion& before, const RefineState& state,
                        const std::vector<uint32_t>& pinned) {
    EditRegion region = before;
    region.vertices.clear();
    for (uint32_t v = 0; v < state.positions.size(); ++v) {
        const bool reached = std::any_of(state.handles.begin(), state.handles.end(), [v](const auto& handle) {
            return handle.distance(v) <= handle.radius;
        });
        if (reached && !std::binary_search(pinned.begin(), pinned.end(), v)) {
            region.vertices.push_back(v);
        }
    }
    region.fields.clear();
    for (const HandleField& handle : state.handles) {
        for (const uint32_t v : region.vertices) {
            region.fields.push_back(handle.distance(v) / handle.radius);
        }
    }
    return region;
}

RefineOptions options_of(const Refine& refine, size_t vertex_count) {
    RefineOptions options;
    options.min_edge = refine.min_edge;
    options.flip = refine.flip;
    switch (refine.criterion) {
    case RefineCriterion::shape:
        options.tolerance = refine.shape_tolerance;
        break;
    case RefineCriterion::space:
        options.tolerance = refine.space_tolerance;
        break;
    case RefineCriterion::both:
        options.tolerance = 1;
        break;
    }
    options.max_vertices = refine.max_vertices.value_or(
        static_cast<uint32_t>(std::min<size_t>(std::max(default_limit, 2 * vertex_count), no_index - 1)));
    return options;
}

RefineSummary summary_of(const RefineReport& report, size_t points_added, const std::string& place,
                         Log& log) {
    RefineSummary summary;
    summary.added = report.added + points_added;
    summary.max_error = report.max_error;
    summary.parted_edges = report.parted_edges;
    summary.parted_error = report.parted_error;
    switch (report.stopped_by) {
    case RefineStop::tolerance:
        summary.stopped_by = "tolerance";
        break;
    case RefineStop::min_edge:
        summary.stopped_by = "min_edge";
        break;
    case RefineStop::max_vertices:
        summary.stopped_by = "max_vertices";
        break;
    case RefineStop::parting:
        summary.stopped_by = "parting";
        break;
    }
    if (report.parted_edges > 0) {
        log.warn(place +
                 ": the surface goes past an occluder on different sides, or is pulled apart in some "
                 "other way: " +
                 std::to_string(report.parted_edges) +
                 " edges there miss the tolerance, however short they are, and were left");
    }
    return summary;
}

double least_angle(std::span<const Triangle> triangles, std::span<const Vec3> positions,
                   const std::vector<uint32_t>& vertices) {
    std::vector<bool> chosen(positions.size(), false);
    for (const uint32_t v : vertices) {
        chosen[v] = true;
    }
    double least = infinity;
    for (const Triangle& t : triangles) {
        if (!chosen[t[0]] && !chosen[t[1]] && !chosen[t[2]]) {
            continue;
        }
        double least_here = infinity;
        for (int i = 0; i < 3; ++i) {
            least_here = std::min(
                least_here, angle_at(positions[t[i]], positions[t[(i + 1) % 3]], positions[t[(i + 2) % 3]]));
        }
        least = least_here > 0 ? std::min(least, least_here) : least;
    }
    return std::isfinite(least) ? glm::degrees(least) : 0;
}

} // namespace anvil

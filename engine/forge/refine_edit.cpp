#include "engine/forge/refine_edit.h"

#include "engine/distance/anchor_blend.h"
#include "engine/mesh/triangle_angles.h"

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

/// A field that every place is within.
HandleField everywhere(size_t vertex_count) {
    HandleField field{ShapeFunction(preset_knots("smooth")), 1, 0, {}};
    field.anchors.push_back({std::vector<double>(vertex_count, 0), SourceKind::line, std::nullopt});
    return field;
}

class Starter {
  public:
    Starter(const Edit& edit, const std::string& place, const Mesh& mesh, std::span<const Vec3> positions,
            SurfaceState& surface)
        : edit_(edit), place_(place), mesh_(mesh), positions_(positions), surface_(surface) {}

    RefineStart run() {
        std::vector<DistanceQuery> queries;
        EditDistances handles = handles_of(edit_, place_, surface_, queries);
        start_.region.handle_positions = std::move(handles.handle_positions);
        start_.region.handle_weights = std::move(handles.handle_weights);
        start_.region.shapes = shapes_of(edit_);
        start_.state.positions.assign(positions_.begin(), positions_.end());
        if (edit_.handles.empty() && edit_.anchors.empty()) {
            start_.state.handles.push_back(everywhere(positions_.size()));
        } else if (edit_.handles.empty()) {
            measure({hammer_query(edit_, place_, surface_)});
            start_.region.methods.clear();
        } else {
            measure(queries);
        }
        fill_region(start_.region, start_.state, handles.pinned);
        return std::move(start_);
    }

  private:
    /// One field a query and anchor, all at once.
    void measure(const std::vector<DistanceQuery>& queries) {
        std::vector<DistanceQuery> each;
        for (const DistanceQuery& query : queries) {
            const double reach = reach_of(query);
            for (const DistanceSources& anchor : query.anchors) {
                each.push_back(query);
                each.back().anchors = {anchor};
                each.back().radius = reach;
            }
        }
        const std::vector<DistanceField> found = surface_.distances(each);
        auto next = found.begin();
        for (size_t j = 0; j < queries.size(); ++j) {
            const DistanceQuery& query = queries[j];
            const bool is_hammer = start_.region.shapes.empty();
            HandleField field{is_hammer ? ShapeFunction(preset_knots("smooth")) : start_.region.shapes[j],
                              1,
                              query.blend_width,
                              {}};
            start_.region.methods.push_back(method_name(query.metric, next->method));
            for (const DistanceSources& anchor : query.anchors) {
                field.anchors.push_back(field_of(query, anchor, *next++));
            }
            set_radius(query, is_hammer ? place_ : place_ + ".handles[" + std::to_string(j) + "]", field);
            start_.region.radii.push_back(field.radius);
            start_.state.handles.push_back(std::move(field));
        }
    }

    double reach_of(const DistanceQuery& query) const {
        if (std::isinf(query.radius)) {
            return infinity;
        }
        const std::vector<Vec3> places = places_of(query.anchors, mesh_, positions_, surface_);
        return blend_reach(needed_reach(mesh_.triangles, positions_, places, query.radius), query.blend_width,
                           query.anchors.size());
    }

    AnchorField field_of(const DistanceQuery& query, const DistanceSources& anchor,
                         const DistanceField& found) const {
        AnchorField field{found.dense(positions_.size()), SourceKind::point, std::nullopt};
        if (anchor.points.empty()) {
            field.kind = SourceKind::line;
        } else if (query.metric == Metric::euclidean) {
            field.straight_from = surface_.position_of(anchor.points[0]);
        }
        return field;
    }

    void set_radius(const DistanceQuery& query, const std::string& place, HandleField& field) const {
        std::vector<double> distances;
        for (uint32_t v = 0; v < positions_.size() && std::isinf(query.radius); ++v) {
            distances.push_back(field.distance(v));
        }
        field.radius = radius_of(query, distances, place);
    }

    const Edit& edit_;
    const std::string& place_;
    const Mesh& mesh_;
    std::span<const Vec3> positions_;
    SurfaceState& surface_;
    RefineStart start_;
};

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

RefineStart start_refinement(const Edit& edit, const std::string& place, const Mesh& mesh,
                             std::span<const Vec3> positions, SurfaceState& surface) {
    return Starter(edit, place, mesh, positions, surface).run();
}

void fill_region(EditRegion& region, const RefineState& state, const std::vector<uint32_t>& pinned) {
    std::vector<uint32_t> vertices;
    for (uint32_t v = 0; v < state.positions.size(); ++v) {
        const bool reached = std::any_of(state.handles.begin(), state.handles.end(), [v](const auto& handle) {
            return handle.distance(v) <= handle.radius;
        });
        if (reached && !std::binary_search(pinned.begin(), pinned.end(), v)) {
            vertices.push_back(v);
        }
    }
    set_vertices(region, vertices, state.positions);
    region.fields.clear();
    for (size_t j = 0; j < region.shapes.size(); ++j) {
        const HandleField& handle = state.handles[j];
        for (const uint32_t v : region.vertices) {
            region.fields.push_back(handle.distance(v) / handle.radius);
        }
    }
}

RefineOptions options_of(const Refine& refine, size_t vertex_count) {
    RefineOptions options;
    options.min_edge = refine.min_edge;
    options.flip = refine.flip;
    options.relax = refine.relax;
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
        const double least_here = least_angle_of(positions[t[0]], positions[t[1]], positions[t[2]]);
        least = least_here > 0 ? std::min(least, least_here) : least;
    }
    return std::isfinite(least) ? glm::degrees(least) : 0;
}

} // namespace anvil

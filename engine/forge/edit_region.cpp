#include "engine/forge/edit_region.h"

#include "engine/core/error.h"
#include "engine/forge/anchor_set.h"

#include <algorithm>

namespace anvil {

namespace {

struct HandleField {
    DistanceField distances;
    double radius;
};

/// Without sources where handle `j` has no anchors.
DistanceQuery anchor_query(const Edit& edit, size_t j, Metric metric, const std::optional<double>& radius,
                           const std::string& place, SurfaceState& surface) {
    DistanceQuery query;
    query.metric = metric;
    query.method = edit.method;
    query.smooth_rounds = metric == Metric::geodesic ? edit.smooth_surface : 0;
    query.radius = radius.value_or(infinity);
    for (size_t a = 0; a < edit.anchors.size(); ++a) {
        if (edit.anchors[a].handle == j) {
            query.anchors = resolve_anchors(edit.anchors[a].at, query.smooth_rounds,
                                            place + ".anchors[" + std::to_string(a) + "]", surface);
            query.blend_width = edit.anchors[a].smooth_width.value_or(0);
        }
    }
    return query;
}

/// Half of the largest finite distance, the default radius of influence.
double half_reach(const DistanceField& field, const std::string& place) {
    double largest = 0;
    for (double d : field.distances) {
        largest = std::max(largest, d);
    }
    if (!(largest > 0)) {
        throw InputError(place +
                         ": nothing but the handle itself is within reach, so the default radius would be 0: "
                         "give \"radius\"");
    }
    return 0.5 * largest;
}

void sort_unique(std::vector<uint32_t>& vertices) {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

/// Every vertex within some handle's radius, ascending, without the pinned ones.
std::vector<uint32_t> region_vertices(const std::vector<HandleField>& fields,
                                      const std::vector<uint32_t>& pinned) {
    std::vector<uint32_t> vertices;
    for (const HandleField& field : fields) {
        for (size_t i = 0; i < field.distances.vertices.size(); ++i) {
            const uint32_t v = field.distances.vertices[i];
            if (field.distances.distances[i] <= field.radius &&
                !std::binary_search(pinned.begin(), pinned.end(), v)) {
                vertices.push_back(v);
            }
        }
    }
    sort_unique(vertices);
    return vertices;
}

/// Index of vertex v in the ascending list, or its size.
size_t place_of(const std::vector<uint32_t>& vertices, uint32_t v) {
    const auto found = std::lower_bound(vertices.begin(), vertices.end(), v);
    return found != vertices.end() && *found == v ? static_cast<size_t>(found - vertices.begin())
                                                  : vertices.size();
}

void fill_fields(const std::vector<HandleField>& fields, EditRegion& region) {
    const size_t n = region.vertices.size();
    region.fields.assign(fields.size() * n, infinity);
    for (size_t j = 0; j < fields.size(); ++j) {
        const DistanceField& field = fields[j].distances;
        for (size_t i = 0; i < field.vertices.size(); ++i) {
            const size_t at = place_of(region.vertices, field.vertices[i]);
            if (at < n) {
                region.fields[j * n + at] = field.distances[i] / fields[j].radius;
            }
        }
    }
}

std::string handle_place(const std::string& place, size_t j) {
    return place + ".handles[" + std::to_string(j) + "]";
}

/// Takes the radius from the query, or the default.
HandleField bounded(DistanceField&& distances, const DistanceQuery& query, const std::string& place) {
    const double radius = std::isinf(query.radius) ? half_reach(distances, place) : query.radius;
    return {std::move(distances), radius};
}

/// Without handles: within the radius of the anchors, or everywhere.
EditRegion hammered_region(const Edit& edit, const std::string& place, SurfaceState& surface) {
    EditRegion region;
    const std::vector<uint32_t> pinned = pinned_vertices(edit, place, surface);
    if (!edit.anchors.empty()) {
        const DistanceQuery query = anchor_query(edit, 0, edit.metric, edit.radius, place, surface);
        const HandleField field = bounded(std::move(surface.distances({&query, 1})[0]), query, place);
        region.radii.push_back(field.radius);
        region.vertices = region_vertices({field}, pinned);
        return region;
    }
    for (uint32_t v = 0; v < surface.vertex_count(); ++v) {
        if (!std::binary_search(pinned.begin(), pinned.end(), v)) {
            region.vertices.push_back(v);
        }
    }
    return region;
}

std::string method_name(Metric metric, const DistanceField& field) {
    if (metric == Metric::euclidean) {
        return "euclidean";
    }
    return field.method == DistanceMethod::exact ? "exact" : "approximate";
}

} // namespace

DistanceQuery query_of(const Edit& edit, size_t j, const SurfacePoint& handle_point, const std::string& place,
                       SurfaceState& surface) {
    const Handle& handle = edit.handles[j];
    DistanceQuery query = anchor_query(edit, j, handle.metric.value_or(edit.metric),
                                       handle.radius ? handle.radius : edit.radius, place, surface);
    if (query.anchors.empty()) {
        query.anchors.emplace_back().points.push_back(handle_point);
    }
    return query;
}

std::vector<uint32_t> pinned_vertices(const Edit& edit, const std::string& place, SurfaceState& surface) {
    std::vector<uint32_t> pinned;
    for (size_t i = 0; i < edit.pinned.size(); ++i) {
        const SurfacePoint point =
            surface.resolve(edit.pinned[i], place + ".pinned[" + std::to_string(i) + "]");
        for (const VertexWeight& w : surface.weights_of(point)) {
            pinned.push_back(w.vertex);
        }
    }
    sort_unique(pinned);
    return pinned;
}

double EditRegion::weight(size_t j, uint32_t v) const {
    const size_t at = place_of(vertices, v);
    return at < vertices.size() ? shapes[j](fields[j * vertices.size() + at]) : 0;
}

EditRegion find_region(const Edit& edit, const std::string& place, SurfaceState& surface) {
    if (edit.handles.empty()) {
        return hammered_region(edit, place, surface);
    }
    EditRegion region;
    std::vector<DistanceQuery> queries;
    for (size_t j = 0; j < edit.handles.size(); ++j) {
        const Handle& handle = edit.handles[j];
        const SurfacePoint point = surface.resolve(handle.at, handle_place(place, j) + ".at");
        region.handle_positions.push_back(surface.position_of(point));
        region.handle_weights.push_back(surface.weights_of(point));
        region.shapes.push_back(make_shape_function(handle.shape.value_or(edit.shape)));
        queries.push_back(query_of(edit, j, point, place, surface));
    }
    std::vector<HandleField> fields;
    for (DistanceField& distances : surface.distances(queries)) {
        const size_t j = fields.size();
        region.methods.push_back(method_name(queries[j].metric, distances));
        fields.push_back(bounded(std::move(distances), queries[j], handle_place(place, j)));
        region.radii.push_back(fields.back().radius);
    }
    region.vertices = region_vertices(fields, pinned_vertices(edit, place, surface));
    fill_fields(fields, region);
    return region;
}

} // namespace anvil

#include "engine/forge/edit_region.h"

#include "engine/core/error.h"
#include "engine/forge/anchor_set.h"
#include "engine/mesh/place_order.h"

#include <algorithm>

namespace anvil {

namespace {

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

/// Ascending: every vertex within some handle's radius, without the pinned ones; all where there is no field.
std::vector<uint32_t> region_vertices(const EditDistances& measured, const std::vector<double>& radii,
                                      VertexNumbers& numbers) {
    const auto pinned = [&](uint32_t v) {
        return std::binary_search(measured.pinned.begin(), measured.pinned.end(), v);
    };
    for (size_t j = 0; j < measured.fields.size(); ++j) {
        const DistanceField& field = measured.fields[j];
        for (size_t i = 0; i < field.vertices.size(); ++i) {
            if (field.distances[i] <= radii[j] && !pinned(field.vertices[i])) {
                numbers.add(field.vertices[i]);
            }
        }
    }
    for (uint32_t v = 0; measured.fields.empty() && v < numbers.vertex_count(); ++v) {
        if (!pinned(v)) {
            numbers.add(v);
        }
    }
    std::vector<uint32_t> vertices = numbers.vertices();
    numbers.clear();
    std::sort(vertices.begin(), vertices.end());
    return vertices;
}

void fill_fields(const EditDistances& measured, EditRegion& region, VertexNumbers& numbers) {
    const size_t n = region.vertices.size();
    for (const uint32_t v : region.vertices) {
        numbers.add(v);
    }
    region.fields.assign(measured.fields.size() * n, infinity);
    for (size_t j = 0; j < measured.fields.size(); ++j) {
        const DistanceField& field = measured.fields[j];
        for (size_t i = 0; i < field.vertices.size(); ++i) {
            const uint32_t at = numbers[field.vertices[i]];
            if (at != no_index) {
                region.fields[j * n + at] = field.distances[i] / region.radii[j];
            }
        }
    }
    numbers.clear();
}

std::string handle_place(const std::string& place, size_t j) {
    return place + ".handles[" + std::to_string(j) + "]";
}

/// Without handles: from the anchors, if there are any.
void measure_from_anchors(const Edit& edit, const std::string& place, SurfaceState& surface,
                          const FieldsFinder& find, EditDistances& measured) {
    if (!edit.anchors.empty()) {
        const DistanceQuery query = hammer_query(edit, place, surface);
        measured.fields = find({&query, 1});
        measured.radii.push_back(radius_of(query, measured.fields[0].distances, place));
    }
}

} // namespace

DistanceQuery query_of(const Edit& edit, size_t j, const SurfacePoint& handle_point, const std::string& place,
                       SurfaceState& surface) {
    const Handle& handle = edit.handles[j];
    DistanceQuery query =
        anchor_query(edit, j, handle.metric.value_or(edit.metric), given_radius(edit, j), place, surface);
    if (query.anchors.empty()) {
        query.anchors.emplace_back().points.push_back(handle_point);
    }
    return query;
}

DistanceQuery hammer_query(const Edit& edit, const std::string& place, SurfaceState& surface) {
    return anchor_query(edit, 0, edit.metric, edit.radius, place, surface);
}

double radius_of(const DistanceQuery& query, const std::vector<double>& distances, const std::string& place) {
    if (std::isfinite(query.radius)) {
        return query.radius;
    }
    double largest = 0;
    for (const double d : distances) {
        largest = std::isfinite(d) ? std::max(largest, d) : largest;
    }
    if (!(largest > 0)) {
        throw InputError(place +
                         ": nothing but the handle itself is within reach, so the default radius would be 0: "
                         "give \"radius\"");
    }
    return 0.5 * largest;
}

std::string method_name(Metric metric, DistanceMethod method) {
    if (metric == Metric::euclidean) {
        return "euclidean";
    }
    return method == DistanceMethod::exact ? "exact" : "approximate";
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
    std::sort(pinned.begin(), pinned.end());
    pinned.erase(std::unique(pinned.begin(), pinned.end()), pinned.end());
    return pinned;
}

size_t EditRegion::index_of(uint32_t v) const {
    const auto found = std::lower_bound(by_vertex.begin(), by_vertex.end(), v,
                                        [&](uint32_t at, uint32_t sought) { return vertices[at] < sought; });
    return found != by_vertex.end() && vertices[*found] == v ? *found : vertices.size();
}

double EditRegion::weight(size_t j, uint32_t v) const {
    const size_t at = index_of(v);
    return at < vertices.size() ? shapes[j](fields[j * vertices.size() + at]) : 0;
}

std::optional<double> given_radius(const Edit& edit, size_t j) {
    return j < edit.handles.size() && edit.handles[j].radius ? edit.handles[j].radius : edit.radius;
}

std::vector<ShapeFunction> shapes_of(const Edit& edit) {
    std::vector<ShapeFunction> shapes;
    for (const Handle& handle : edit.handles) {
        shapes.push_back(make_shape_function(handle.shape.value_or(edit.shape)));
    }
    return shapes;
}

EditDistances handles_of(const Edit& edit, const std::string& place, SurfaceState& surface,
                         std::vector<DistanceQuery>& queries) {
    EditDistances measured;
    for (size_t j = 0; j < edit.handles.size(); ++j) {
        const SurfacePoint point = surface.resolve(edit.handles[j].at, handle_place(place, j) + ".at");
        measured.handle_positions.push_back(surface.position_of(point));
        measured.handle_weights.push_back(surface.weights_of(point));
        queries.push_back(query_of(edit, j, point, place, surface));
    }
    measured.pinned = pinned_vertices(edit, place, surface);
    return measured;
}

EditDistances measure_distances(const Edit& edit, const std::string& place, SurfaceState& surface) {
    return measure_distances(edit, place, surface, [&](std::span<const DistanceQuery> queries) {
        return surface.distances(queries);
    });
}

EditDistances measure_distances(const Edit& edit, const std::string& place, SurfaceState& surface,
                                const FieldsFinder& find) {
    std::vector<DistanceQuery> queries;
    EditDistances measured = handles_of(edit, place, surface, queries);
    if (edit.handles.empty()) {
        measure_from_anchors(edit, place, surface, find, measured);
    } else {
        measured.fields = find(queries);
    }
    for (size_t j = 0; j < queries.size(); ++j) {
        const DistanceField& field = measured.fields[j];
        measured.methods.push_back(method_name(queries[j].metric, field.method));
        measured.radii.push_back(radius_of(queries[j], field.distances, handle_place(place, j)));
    }
    return measured;
}

EditRegion region_within(const Edit& edit, const EditDistances& measured, const std::vector<double>& radii,
                         std::span<const Vec3> positions, VertexNumbers& numbers) {
    EditRegion region;
    region.handle_positions = measured.handle_positions;
    region.handle_weights = measured.handle_weights;
    region.radii = radii;
    region.methods = measured.methods;
    region.shapes = shapes_of(edit);
    set_vertices(region, region_vertices(measured, radii, numbers), positions);
    if (!edit.handles.empty()) {
        fill_fields(measured, region, numbers);
    }
    return region;
}

void set_vertices(EditRegion& region, const std::vector<uint32_t>& ascending,
                  std::span<const Vec3> positions) {
    std::vector<Vec3> places;
    places.reserve(ascending.size());
    for (const uint32_t v : ascending) {
        places.push_back(positions[v]);
    }
    const std::vector<uint32_t> order = order_by_place(places);
    region.vertices.resize(order.size());
    region.by_vertex.resize(order.size());
    for (uint32_t i = 0; i < order.size(); ++i) {
        region.vertices[i] = ascending[order[i]];
        region.by_vertex[order[i]] = i;
    }
}

EditRegion find_region(const Edit& edit, const std::string& place, SurfaceState& surface) {
    VertexNumbers numbers(surface.vertex_count());
    const EditDistances measured = measure_distances(edit, place, surface);
    return region_within(edit, measured, measured.radii, surface.positions(), numbers);
}

} // namespace anvil

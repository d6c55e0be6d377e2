#include "engine/forge/edit_region.h"

#include "engine/core/error.h"

#include <algorithm>

namespace anvil {

namespace {

struct HandleField {
    DistanceField distances;
    double radius;
};

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

/// Without handles: within the radius of the anchors, or everywhere.
EditRegion hammered_region(const Edit& edit, const std::string& place, SurfaceState& surface) {
    EditRegion region;
    const std::vector<uint32_t> pinned = pinned_vertices(edit, place, surface);
    if (!edit.anchors.empty()) {
        const auto sources = sources_of(edit, 0, {}, place, surface);
        HandleField field{
            surface.distances(sources, edit.metric, edit.method, edit.radius.value_or(infinity)), 0};
        field.radius = edit.radius ? *edit.radius : half_reach(field.distances, place);
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

std::vector<SurfacePoint> sources_of(const Edit& edit, size_t handle, const SurfacePoint& handle_point,
                                     const std::string& place, SurfaceState& surface) {
    for (size_t a = 0; a < edit.anchors.size(); ++a) {
        if (edit.anchors[a].handle != handle) {
            continue;
        }
        std::vector<SurfacePoint> sources;
        for (size_t i = 0; i < edit.anchors[a].at.size(); ++i) {
            const std::string where =
                place + ".anchors[" + std::to_string(a) + "].at[" + std::to_string(i) + "]";
            sources.push_back(surface.resolve(edit.anchors[a].at[i], where));
        }
        return sources;
    }
    return {handle_point};
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
    std::vector<HandleField> fields;
    for (size_t j = 0; j < edit.handles.size(); ++j) {
        const Handle& handle = edit.handles[j];
        const std::string where = place + ".handles[" + std::to_string(j) + "]";
        const SurfacePoint point = surface.resolve(handle.at, where + ".at");
        region.handle_positions.push_back(surface.position_of(point));
        region.handle_weights.push_back(surface.weights_of(point));
        region.shapes.push_back(make_shape_function(handle.shape.value_or(edit.shape)));

        const Metric metric = handle.metric.value_or(edit.metric);
        const std::optional<double> radius = handle.radius ? handle.radius : edit.radius;
        const auto sources = sources_of(edit, j, point, place, surface);
        HandleField field{surface.distances(sources, metric, edit.method, radius.value_or(infinity)), 0};
        field.radius = radius ? *radius : half_reach(field.distances, where);
        region.radii.push_back(field.radius);
        region.methods.push_back(method_name(metric, field.distances));
        fields.push_back(std::move(field));
    }
    region.vertices = region_vertices(fields, pinned_vertices(edit, place, surface));
    fill_fields(fields, region);
    return region;
}

} // namespace anvil

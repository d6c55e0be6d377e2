#include "engine/forge/edit_input.h"

#include "engine/core/error.h"
#include "engine/deform/contact_finish.h"

#include <algorithm>

namespace anvil {

LocalFrame local_frame(const Mesh& mesh) {
    const Box box = bounds(mesh);
    return {box.empty() ? Vec3(0) : box.centre(), box.diagonal()};
}

void set_shapes(std::span<const ShapeFunction> shapes, DeformInput& input) {
    input.segments.clear();
    input.shapes.clear();
    for (const ShapeFunction& shape : shapes) {
        input.shapes.push_back(
            {static_cast<uint32_t>(input.segments.size()), static_cast<uint32_t>(shape.segments().size())});
        for (const auto& s : shape.segments()) {
            input.segments.push_back({s.begin, s.c0, s.c1, s.c2, s.c3});
        }
    }
}

DeformInput deform_input(const EditRegion& region, std::span<const Vec3> positions, const Vec3& origin,
                         OccluderSet occluders) {
    DeformInput input;
    input.handle_count = region.shapes.size();
    input.fields = region.fields;
    input.points.reserve(region.vertices.size());
    for (const uint32_t v : region.vertices) {
        input.points.push_back(positions[v] - origin);
    }
    set_shapes(region.shapes, input);
    input.occluders = std::move(occluders);
    find_start_distances(input);
    return input;
}

double largest_radius(const EditRegion& region, double diagonal) {
    return region.radii.empty() ? 0.5 * diagonal
                                : *std::max_element(region.radii.begin(), region.radii.end());
}

EditEnds finished_ends(const DeformInput& input, std::span<const PointResult> results) {
    EditEnds result;
    const size_t n = input.points.size();
    result.displacements.resize(n);
    result.ends.resize(n);
    result.inside.resize(n);
    for (size_t i = 0; i < n; ++i) {
        if (!is_finite(results[i].displacement)) {
            throw InternalError("point " + std::to_string(i) + " of an edit was moved to no place");
        }
        result.displacements[i] = results[i].displacement;
        result.ends[i] = input.points[i] + results[i].displacement;
        result.inside[i] = (results[i].flags & kernel::f64::VERTEX_STARTED_INSIDE) != 0;
    }
    if (!input.occluders.empty() && !input.occluders.paper) {
        const std::vector<Vec3> unfinished = result.ends;
        result.finished_on_cpu = finish_contact(input.occluders, input.points, result.inside, result.ends);
        for (size_t i = 0; i < n; ++i) {
            result.displacements[i] += result.ends[i] - unfinished[i];
        }
    }
    return result;
}

} // namespace anvil

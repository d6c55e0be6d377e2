#include "engine/mesh/surface_point.h"

#include "engine/core/error.h"

namespace anvil {

SurfacePoint snapped(const SurfacePoint& point) {
    if (point.triangle == no_index) {
        return point;
    }
    Vec3 b = point.barycentric;
    for (int i = 0; i < 3; ++i) {
        if (b[i] >= 1 - barycentric_snap) {
            b = Vec3(0);
            b[i] = 1;
            return {point.triangle, b, point.vertex};
        }
    }
    for (int i = 0; i < 3; ++i) {
        b[i] = b[i] < barycentric_snap ? 0 : b[i];
    }
    const double sum = b.x + b.y + b.z;
    return {point.triangle, sum == 1 ? b : b / sum, point.vertex};
}

bool is_vertex(const SurfacePoint& point) {
    const Vec3& b = point.barycentric;
    return point.triangle == no_index || std::max({b.x, b.y, b.z}) == 1;
}

Vec3 position(const Mesh& mesh, std::span<const Vec3> positions, const SurfacePoint& point) {
    Vec3 sum(0);
    for (const VertexWeight& entry : vertex_weights(mesh, point)) {
        // A lone vertex gives its position bit for bit.
        sum = entry.weight == 1 ? positions[entry.vertex] : sum + entry.weight * positions[entry.vertex];
    }
    return sum;
}

SurfacePoint vertex_point(const Mesh& mesh, uint32_t vertex) {
    if (vertex >= mesh.vertex_count()) {
        throw InputError("vertex " + std::to_string(vertex) + " does not exist: the mesh has " +
                         std::to_string(mesh.vertex_count()) + " vertices (counted from 0)");
    }
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (int i = 0; i < 3; ++i) {
            if (mesh.triangles[t][i] == vertex) {
                SurfacePoint point{static_cast<uint32_t>(t), Vec3(0), vertex};
                point.barycentric[i] = 1;
                return point;
            }
        }
    }
    return {no_index, Vec3(0), vertex};
}

VertexWeights vertex_weights(const Mesh& mesh, const SurfacePoint& point) {
    if (point.triangle == no_index) {
        return {{{{point.vertex, 1}}}, 1};
    }
    const Triangle& corners = mesh.triangles[point.triangle];
    const Vec3 barycentric = snapped(point).barycentric;
    VertexWeights weights;
    for (int i = 0; i < 3; ++i) {
        if (barycentric[i] == 0) {
            continue;
        }
        size_t slot = 0;
        while (slot < weights.count && weights.entries[slot].vertex != corners[i]) {
            ++slot;
        }
        weights.entries[slot].vertex = corners[i];
        weights.entries[slot].weight += barycentric[i];
        weights.count = std::max(weights.count, slot + 1);
    }
    return weights;
}

} // namespace anvil

// Points on the triangles of a mesh: handles, anchors and distance sources stand on them.
#pragma once

#include "engine/mesh/mesh.h"

#include <array>
#include <span>

namespace anvil {

/// A point of a mesh by its triangle (index into Mesh::triangles) and the weights of the triangle's corners:
/// each in [0, 1], sum 1. One weight 1: the corner itself; one weight 0: a point of an edge. An isolated
/// vertex lies on no triangle: there `triangle` is no_index and `vertex` names it; `vertex` may be unset
/// elsewhere.
struct SurfacePoint {
    uint32_t triangle = no_index;
    Vec3 barycentric{0};
    uint32_t vertex = no_index;
};

/// A vertex's share in a point.
struct VertexWeight {
    uint32_t vertex = no_index;
    double weight = 0;
};

/// The vertices that carry a point, 1 to 3 of them, none twice and none with weight 0.
struct VertexWeights {
    std::array<VertexWeight, 3> entries;
    size_t count = 0;

    const VertexWeight* begin() const { return entries.data(); }
    const VertexWeight* end() const { return entries.data() + count; }
};

/// Barycentrics this close to 0 or 1 are rounding of a point on an edge or at a vertex.
inline constexpr double barycentric_snap = 1e-9;

/// The point with weights below barycentric_snap (or negative) set to 0 and the rest summing to 1. A point
/// whose largest weight is at least 1 - barycentric_snap becomes exactly that corner.
SurfacePoint snapped(const SurfacePoint& point);

/// Whether a snapped point is a vertex.
bool is_vertex(const SurfacePoint& point);

/// Position of `point` with the mesh's vertices at `positions` (same count as mesh.positions).
Vec3 position(const Mesh& mesh, std::span<const Vec3> positions, const SurfacePoint& point);

/// Vertex `vertex` as a point of its first triangle, or of none if it is isolated; O(triangles).
/// @throws InputError if there is no such vertex.
SurfacePoint vertex_point(const Mesh& mesh, uint32_t vertex);

/// The vertices under `point`, snapped. A vertex that a degenerate triangle names twice is listed once.
VertexWeights vertex_weights(const Mesh& mesh, const SurfacePoint& point);

} // namespace anvil

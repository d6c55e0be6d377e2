// What the CPU sees to after a back end: no vertex that started outside ends inside, by exact distances in
// double.
#pragma once

#include "engine/core/types.h"
#include "engine/occluder/occluder_set.h"

#include <span>
#include <vector>

namespace anvil {

/// What touches one occluder: is within `contact_distance` of where contact sets vertices down (its surface,
/// or as far off as its sampled field may err), or inside.
struct OccluderContact {
    std::vector<uint32_t> points;    ///< ascending, of those measured
    std::vector<uint32_t> triangles; ///< ascending, of those measured; in one of 15 places at least
};

/// Counts of one edit's contact; lengths in world units.
struct ContactReport {
    size_t started_inside = 0;
    size_t penetrating_vertices =
        0;                      ///< of those that started outside, deeper than 1e-6 of the occluder's size
    double max_penetration = 0; ///< of those that started outside
    size_t penetrating_triangles = 0;
    double deepest_dip = 0; ///< deepest sampled point of a penetrating triangle
    size_t finished_on_cpu = 0;
    /// Of the region, that end within 1e-3 of the occluder's size of where contact sets vertices down (its
    /// surface, or as far off as its sampled field may err).
    size_t contact_vertices = 0;
    std::vector<OccluderContact> occluders; ///< one each
};

/// Moves each point of `ends` that is inside an occluder at the end of the edit, although its `start` was
/// outside, to the closest point of the surface; where that fails (wedges), back along the segment to its
/// start until it is outside, the start carried along with the occluder if that moved. `inside[i]`: the point
/// started inside and is left alone; so is one that did not move while the occluders stood still. All
/// relative to the local origin.
/// @return how many were moved.
size_t finish_contact(const OccluderSet& set, std::span<const Vec3> starts, const std::vector<bool>& inside,
                      std::span<Vec3> ends);

// What follows takes the set as it stands at the end.

/// Fills penetrating_vertices, max_penetration, contact_vertices and the occluders' points.
void measure_vertices(const OccluderSet& set, std::span<const Vec3> ends, const std::vector<bool>& inside,
                      ContactReport& report);

/// Fills penetrating_triangles, deepest_dip and the occluders' triangles: a triangle is certified outside if
/// a corner is farther out than it is from the triangle's other points; all others are sampled (edges and
/// inside, 15 points). `positions` in world space, `origin`: the local origin; only those that `triangles`
/// name are read.
void measure_triangles(const OccluderSet& set, std::span<const Vec3> positions, const Vec3& origin,
                       std::span<const Triangle> triangles, ContactReport& report);

} // namespace anvil

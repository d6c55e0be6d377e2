// The vertices within an outline in the window.
#pragma once

#include "app/viewer/drag_motion.h"
#include "app/viewer/pick_surface.h"

#include <span>
#include <vector>

namespace anvil {

/// Whether (x, y) lies within the closed polygon, even-odd.
bool within(std::span<const Cursor> outline, double x, double y);

/// Vertices whose places in the window lie within the closed polygon, ascending. Unless `through`, only those
/// that the eye sees: nothing of the surface lies in front. On all cores, O(vertices) and a ray for each one
/// in the polygon.
std::vector<uint32_t> vertices_within(const OrbitCamera& camera, std::span<const Cursor> outline,
                                      const PickSurface& surface, bool through);

/// What a click at a place means: the vertex that is within a few pixels of the ray's hit, else all corners
/// of the face that was hit; nothing beside the surface.
std::vector<uint32_t> vertices_under(const OrbitCamera& camera, const Cursor& at, const PickSurface& surface);

} // namespace anvil

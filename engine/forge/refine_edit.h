// Refinement as a stage of an edit: which places become vertices, and the region over them.
#pragma once

#include "engine/core/log.h"
#include "engine/forge/edit_region.h"
#include "engine/forge/report.h"
#include "engine/refine/adaptive_refinement.h"

namespace anvil {

/// The points of an edit that are vertices before anything else is refined: handles, pinned points,
/// and anchors (lines by every edge that they cross).
std::vector<SurfacePoint> points_of(const Edit& edit, const std::string& place, SurfaceState& surface);

/// What refinement starts from: the handles' distances at every vertex, one field per anchor, as far as it
/// needs them. The points of the edit are vertices of `mesh`.
RefineState start_refinement(const Edit& edit, const EditRegion& region, const std::string& place,
                             const Mesh& mesh, std::span<const Vec3> positions, SurfaceState& surface);

/// The region with the vertices that were added, by the distances that they got.
EditRegion region_after(const EditRegion& before, const RefineState& state,
                        const std::vector<uint32_t>& pinned);

RefineOptions options_of(const Refine& refine, size_t vertex_count);

/// Warns where the edit, `place`, parts the surface.
RefineSummary summary_of(const RefineReport& report, size_t points_added, const std::string& place, Log& log);

/// Least angle, in degrees, of the triangles with a corner among the (ascending) vertices that are not
/// degenerate; 0 if there are none.
double least_angle(std::span<const Triangle> triangles, std::span<const Vec3> positions,
                   const std::vector<uint32_t>& vertices);

} // namespace anvil

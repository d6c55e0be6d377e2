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

/// What refinement starts from.
struct RefineStart {
    EditRegion region; ///< as find_region() finds it, its distances measured once
    /// The handles' distances at every vertex, one field per anchor, as far as refinement needs them. Without
    /// handles there is one for what the hammer may act on: its anchors, or a field that is 0 everywhere.
    RefineState state;
};

/// The points of the edit are vertices of `mesh`. @throws InputError as find_region() does.
RefineStart start_refinement(const Edit& edit, const std::string& place, const Mesh& mesh,
                             std::span<const Vec3> positions, SurfaceState& surface);

/// Fills in the vertices and fields of the region by the distances at all vertices.
void fill_region(EditRegion& region, const RefineState& state, const std::vector<uint32_t>& pinned);

RefineOptions options_of(const Refine& refine, size_t vertex_count);

/// Warns where the edit, `place`, parts the surface.
RefineSummary summary_of(const RefineReport& report, size_t points_added, const std::string& place, Log& log);

/// Least angle, in degrees, of the triangles with a corner among the (ascending) vertices that are not
/// degenerate; 0 if there are none.
double least_angle(std::span<const Triangle> triangles, std::span<const Vec3> positions,
                   const std::vector<uint32_t>& vertices);

} // namespace anvil

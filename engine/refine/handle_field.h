// What refinement knows of an edit's handles: distances at the vertices and the shape function over them.
#pragma once

#include "engine/edit/shape_function.h"
#include "engine/refine/edge_distance.h"

#include <optional>
#include <span>
#include <vector>

namespace anvil {

/// Distance of every vertex from one anchor. `straight_from`: the anchor's place where the distance is
/// straight through space; new vertices are then measured from it directly.
struct AnchorField {
    std::vector<double> distances; ///< world units, +inf where not reached
    SourceKind kind = SourceKind::point;
    std::optional<Vec3> straight_from;
};

/// One handle: its weight at a place is shape(gamma / radius), gamma the least of its anchors' distances
/// (eq. 10), or their smooth minimum of width `blend`.
struct HandleField {
    ShapeFunction shape;
    double radius = 1; ///< world units, > 0
    double blend = 0;  ///< world units, >= 0
    std::vector<AnchorField> anchors;

    /// gamma of a place at these distances from the anchors, at least one.
    double blended(std::span<const double> distances) const;
    /// gamma at a vertex.
    double distance(uint32_t vertex) const;
};

/// A place where the shape function's rule changes: the end of a segment.
struct ShapeLevel {
    double distance = 0; ///< gamma there, world units
    bool kink = false;   ///< the slopes of both sides differ
};

/// Levels above 0, ascending, gamma = R among them.
std::vector<ShapeLevel> shape_levels(const HandleField& handle);

} // namespace anvil

// Several anchors of one handle: the nearest one counts, or a smooth blend of all.
#pragma once

#include "engine/distance/distance.h"

#include <functional>

namespace anvil {

/// Smooth minimum of distances, 0 on the anchors:
///   m - u log sum_i exp((m - g_i) / u),   m = min g_i,   u = w h / (h + w log n),   h = (sum_i
///   g_i^-4)^(-1/4).
/// Between 0 and m; m minus it is at most w log n; once differentiable wherever the g_i are and none is 0;
/// symmetric. The usual log-sum-exp (u = w) falls below 0 near an anchor, so u shrinks there: h <= m keeps u
/// log n <= m. `distances`: n >= 1 numbers >= 0, +inf allowed. `width` w >= 0, 0 is the plain minimum.
double smooth_minimum(std::span<const double> distances, double width);

/// How far single fields must reach for their smooth minimum to be right up to `radius` (to 2e-9 widths).
double blend_reach(double radius, double width, size_t anchors);

/// The single fields that distances to anchors are made of, and how far each must reach.
struct AnchorFields {
    std::vector<DistanceSources> sources;
    double reach = 0;
};

/// All anchors together where `width` is 0, else one field each. @throws InputError if the width is negative
/// or not finite.
AnchorFields fields_of_anchors(std::span<const DistanceSources> anchors, double radius, double width);

/// The smooth minimum of fields that reach so far, up to `radius`; a single one as it is.
DistanceField blended(std::vector<DistanceField> fields, double radius, double width);

/// Finds the distances of vertices from sources up to a radius, with any metric. Called from several threads
/// at once.
using FieldFinder = std::function<DistanceField(const DistanceSources& sources, double radius)>;

/// Distances to a set of anchors, for all vertices not farther than `radius`: eq. 10 of Bendels & Klein 2003
/// where `width` is 0, else the smooth minimum of one field per anchor, found on all cores. Anchors in one
/// place count as many: give each once. @throws InputError as `find` does, and if the width is negative or
/// not finite.
DistanceField anchor_distances(std::span<const DistanceSources> anchors, double radius, double width,
                               const FieldFinder& find);

} // namespace anvil

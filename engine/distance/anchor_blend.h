// Several anchors of one handle: the nearest one counts, or a smooth blend of all.
#pragma once

#include "engine/distance/distance.h"

namespace anvil {

/// Smooth minimum of distances, 0 on the anchors:
///   m - u log sum_i exp((m - g_i) / u),   m = min g_i,   u = w h / (h + w log n),   h = (sum_i
///   g_i^-4)^(-1/4).
/// Between 0 and m; m minus it is at most w log n; once differentiable wherever the g_i are and none is 0;
/// symmetric. The usual log-sum-exp (u = w) falls below 0 near an anchor, so u shrinks there: h <= m keeps u
/// log n <= m. `distances`: n >= 1 numbers >= 0, +inf allowed. `width` w >= 0, 0 is the plain minimum.
double smooth_minimum(std::span<const double> distances, double width);

/// Distances to a set of anchors, for all vertices not farther than `radius`: eq. 10 of Bendels & Klein 2003
/// where `width` is 0, else the smooth minimum of one field per anchor, found on all cores. Anchors in one
/// place count once. @throws InputError as GeodesicSolver::solve does, and if the width is negative or not
/// finite.
DistanceField anchor_distances(const GeodesicSolver& solver, std::span<const SurfacePoint> anchors,
                               double radius, double width,
                               DistanceMethod method = DistanceMethod::automatic);

} // namespace anvil

// The error of linear interpolation in space: what the whole edit does, occluders included.
#pragma once

#include "engine/refine/adaptive_refinement.h"

#include <functional>

namespace anvil {

/// Where the edit takes points: n places, with gamma of each of the k handles (k x n, handle by handle).
using MovePoints =
    std::function<std::vector<Vec3>(std::span<const Vec3> places, const std::vector<double>& distances)>;

/// eps = |f(v(s)) - linear interpolation of f at the ends|, f the edit: world units, sampled at 3 to 7 places
/// an edge and at kinks of the shapes; and the same at 4 points inside each face, so that none dips into an
/// occluder between its edges. Asks for points in large batches. An edge no longer than `parting_length` is
/// parted if f makes a part of it longer than the tolerance and 20 times longer than it was: where f jumps,
/// since the surface goes past an occluder on two sides, that is so however short the edges are.
std::unique_ptr<EdgeCriterion> make_space_criterion(MovePoints move, double parting_length);

/// The worse of shape and space, each over its tolerance: the tolerance of both is 1. Edges no longer than
/// the tolerance in space can be parted.
std::unique_ptr<EdgeCriterion> make_both_criteria(double shape_tolerance, MovePoints move,
                                                  double space_tolerance);

} // namespace anvil

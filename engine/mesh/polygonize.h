// From an implicit solid to a triangle mesh.
#pragma once

#include "engine/mesh/mesh.h"

#include <functional>

namespace anvil {

/// A function of space; a solid is where it is negative. Called from several threads at once.
using ScalarField = std::function<double(const Vec3&)>;

struct PolygonizeOptions {
    int cells = 64;     ///< along the longest side of the box, 1 to 2048
    bool sharp = false; ///< edges and corners of f's kinks come out sharp, each cell's vertex within its cell
    bool lipschitz =
        false; ///< |f(p) - f(q)| <= |p - q| everywhere: lets cells far from the surface be skipped
};

/// Triangle mesh of {f = 0}: closed, manifold (no edge with other than two triangles, no bow-tie vertex),
/// oriented outwards; empty where f is nowhere negative at a grid point. Features under a cell's size may be
/// lost. What reaches out of `box` is cut off within a cell or two beyond it. A sample that is not a number
/// counts as outside. Dual contouring with one vertex for every sheet that passes a cell; the vertices lie on
/// f = 0 (to second order in the cell size at sharp features). The same input gives the same mesh bit for
/// bit.
/// @throws InputError if the box is empty, flat or not finite, or `cells` is out of range.
Mesh polygonize(const ScalarField& f, const Box& box, const PolygonizeOptions& options = {});

} // namespace anvil

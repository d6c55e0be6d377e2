// A shape function as a curve that is drawn by hand: knots, slopes, kinks.
#pragma once

#include "engine/edit/recipe.h"

#include <cstddef>

namespace anvil {

class CurveEditor {
  public:
    /// Within a panel. Drag a knot or the end of its slope; double click: a new knot; right click: without
    /// it. The last knot stays at t = 1 with value 0. Returns whether the shape changed; it is always one
    /// that make_shape_function() takes.
    bool show(ShapeChoice& shape);

  private:
    enum class Part : uint8_t { none, knot, left, right };

    size_t selected_ = 0;
    Part dragged_ = Part::none;
};

/// The same knots, those of a preset written out.
ShapeChoice with_own_knots(const ShapeChoice& shape);

/// A knot on the curve, with its slope there: the function is the same. Nothing where there is one already.
/// @pre own knots; returns its index, or that of the nearest.
size_t add_knot(ShapeChoice& shape, double t);

/// Moves a knot as far as its neighbours and the format allow; the last one stays.
void move_knot(ShapeChoice& shape, size_t index, double t, double value);

/// Without the knot, unless it is the first, the last, or one of two.
bool remove_knot(ShapeChoice& shape, size_t index);

} // namespace anvil

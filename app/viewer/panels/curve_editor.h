// A shape function as a curve that is drawn by hand: knots, slopes, kinks.
#pragma once

#include "app/viewer/panels/curve_files.h"
#include "engine/edit/recipe.h"

#include <array>
#include <cstddef>

namespace anvil {

class CurveEditor {
  public:
    /// Knots go no higher than `most_value` and no lower than its negative.
    explicit CurveEditor(double most_value = 4) : most_value_(most_value) {}

    /// Within a panel. Drag a knot or the end of its slope; double click: a new knot; right click: without
    /// it. The last knot stays at t = 1 with value 0. Below it curves of files. Returns whether the shape
    /// changed; it is always one that make_shape_function() takes.
    bool show(ShapeChoice& shape);

  private:
    enum class Part : uint8_t { none, knot, left, right };
    struct Canvas;
    struct Slopes;

    void draw(const Canvas& canvas, const ShapeChoice& shape, const Slopes& slopes) const;
    std::optional<size_t> knot_under_mouse(const Canvas& canvas, const ShapeChoice& shape) const;
    bool click(const Canvas& canvas, const Slopes& slopes, ShapeChoice& shape);
    bool drag(const Canvas& canvas, ShapeChoice& shape) const;

    double most_value_;
    size_t selected_ = 0;
    Part dragged_ = Part::none;
    CurveFiles files_;
};

/// The same knots, those of a preset written out.
ShapeChoice with_own_knots(const ShapeChoice& shape);

/// A knot on the curve, with its slope there: the function is the same. Nothing where there is one already.
/// @pre own knots; returns its index, or that of the nearest.
size_t add_knot(ShapeChoice& shape, double t);

/// Moves a knot as far as its neighbours, the format and `most_value` allow; the last one stays.
void move_knot(ShapeChoice& shape, size_t index, double t, double value, double most_value = 4);

/// Gives a knot a slope on one side, or on both if it has no kink and `kink` makes none.
void turn_slope(Knot& knot, bool left, double slope, bool kink);

/// Without the knot, unless it is the first, the last, or one of two.
bool remove_knot(ShapeChoice& shape, size_t index);

} // namespace anvil

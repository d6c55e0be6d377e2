// Controls that several panels share.
#pragma once

#include "engine/edit/recipe.h"

namespace anvil {

/// The width of the panels at the window's sides, pixels.
constexpr float side_width = 290;

/// A slider for lengths from a thousandth of `size` to all of it. Whether it was moved.
bool length_slider(const char* label, double& value, double size);

/// Whether another preset was chosen.
bool shape_combo(const char* label, ShapeChoice& shape);

} // namespace anvil

// Controls that several panels share.
#pragma once

#include "engine/edit/recipe.h"

namespace anvil {

/// Pixels of what is one pixel on a display of 96 dots an inch. Within a frame of ImGui.
float unit();

/// The width of the panels at the window's sides, pixels.
float side_width();

/// A slider for lengths from a thousandth of `size` to all of it. Whether it was moved.
bool length_slider(const char* label, double& value, double size);

/// Whether another preset was chosen.
bool shape_combo(const char* label, ShapeChoice& shape);

} // namespace anvil

// All that a past edit's record says, as controls.
#pragma once

#include "app/viewer/panels/curve_editor.h"
#include "engine/edit/recipe.h"

namespace anvil {

class EditDetails {
  public:
    /// Within a panel. Whether `edit` was changed; `scene`: the bounds of the mesh.
    bool show(Edit& edit, const Box& scene);

  private:
    bool show_occluders(Edit& edit, double size);

    CurveEditor curve_;
    CurveEditor influence_{1};
};

} // namespace anvil

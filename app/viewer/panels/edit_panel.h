// What the edit under way is made with: tool, radius, shape, distance, refinement.
#pragma once

#include "app/viewer/panels/curve_editor.h"
#include "app/viewer/panels/panel_column.h"
#include "app/viewer/session.h"

namespace anvil {

class EditPanel {
  public:
    void show(Session& session, PanelColumn& column);

  private:
    CurveEditor curve_;
};

} // namespace anvil

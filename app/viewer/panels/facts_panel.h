// What the mesh is like and what is wrong with it, what the last edit took, and on which device.
#pragma once

#include "app/viewer/panels/panel_column.h"
#include "app/viewer/session.h"

namespace anvil {

/// A panel that can be closed, below what the column has.
void show_facts(Session& session, PanelColumn& column, bool& open);

} // namespace anvil

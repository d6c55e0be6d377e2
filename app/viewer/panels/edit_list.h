// The edits that were taken: each can be changed, and all after it are made again.
#pragma once

#include "app/viewer/panels/panel_column.h"
#include "app/viewer/session.h"

namespace anvil {

void show_edit_list(Session& session, PanelColumn& column);

} // namespace anvil

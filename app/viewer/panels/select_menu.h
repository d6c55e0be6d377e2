// The menu of the selection.
#pragma once

#include "app/viewer/session.h"

namespace anvil {

void select_menu(Session& session);

} // namespace anvil

// What the mesh is like and what is wrong with it, what the last edit took, and on which device.
#pragma once

#include "app/viewer/session.h"

namespace anvil {

/// A window that can be closed.
void show_facts(Session& session, bool& open);

} // namespace anvil

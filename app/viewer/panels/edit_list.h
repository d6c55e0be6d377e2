// The edits that were taken: each can be changed, and all after it are made again.
#pragma once

#include "app/viewer/session.h"

namespace anvil {

void show_edit_list(Session& session);

} // namespace anvil

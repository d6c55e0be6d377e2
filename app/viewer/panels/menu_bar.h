// The menus at the window's top.
#pragma once

#include "app/viewer/panels/file_dialogs.h"

namespace anvil {

void show_menu(Session& session, FileDialogs& files);

} // namespace anvil

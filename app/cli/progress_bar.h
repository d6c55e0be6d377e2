// How far long work is, on a terminal.
#pragma once

#include "engine/core/progress.h"

namespace anvil {

/// A listener that draws a bar on stderr while it is a terminal, and does nothing elsewhere.
Progress::Listener progress_bar();

/// Takes the bar off the screen, so that messages start on a clean line.
void clear_progress_bar();

} // namespace anvil

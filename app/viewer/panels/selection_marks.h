// Box and lasso over the window, and the pins that last.
#pragma once

#include "app/viewer/marks.h"
#include "app/viewer/session.h"

namespace anvil {

void draw_selection_marks(const Session& session, Marks& marks);

} // namespace anvil

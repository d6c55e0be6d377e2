// Lines along the surface: those of handles, and the one that is drawn.
#pragma once

#include "app/viewer/marks.h"
#include "app/viewer/session.h"

namespace anvil {

void draw_line_marks(const Session& session, Marks& marks);

} // namespace anvil

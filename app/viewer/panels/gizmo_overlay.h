// Over the scene: the selected occluder's gizmo, recorded ways, and what touches.
#pragma once

#include "app/viewer/marks.h"
#include "app/viewer/session.h"

namespace anvil {

void draw_contact(const Session& session, Marks& marks);
void draw_ways(const Session& session, Marks& marks);
/// Behind all panels, and wherever it is grabbed: no surface hides it. Within a frame of ImGui.
void draw_gizmo(const Session& session);

} // namespace anvil

// Over the scene: the selected occluder's gizmo, recorded ways, and what touches.
#pragma once

#include "app/viewer/session.h"

namespace anvil {

/// Draws behind all panels. Within a frame of ImGui.
void draw_contact(const Session& session);
void draw_gizmo(const Session& session);

} // namespace anvil

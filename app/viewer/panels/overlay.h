// Marks over the surface: where the cursor is, handles, anchors, pins, and where a handle is wanted.
#pragma once

#include "app/viewer/session.h"

namespace anvil {

/// Draws behind all panels. Within a frame of ImGui.
void draw_overlay(const Session& session);

} // namespace anvil

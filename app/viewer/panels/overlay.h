// Marks over the surface: where the cursor is, handles, anchors, pins, and where a handle is wanted.
#pragma once

#include "app/viewer/marks.h"
#include "app/viewer/session.h"

namespace anvil {

/// Adds to the marks of the frame; what is no part of the scene is drawn behind all panels. Within a frame of
/// ImGui.
void draw_overlay(const Session& session, Marks& marks);

} // namespace anvil

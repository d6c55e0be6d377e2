// What goes on: a line of counts and times at the window's foot, and messages above it.
#pragma once

#include "app/viewer/session.h"

namespace anvil {

/// How long the last frames took.
struct FrameTimes {
    double milliseconds = 0;
};

/// Pixels at the window's foot: what there is to say in two lines, more where the window is narrow.
float status_height(Session& session, const FrameTimes& times);
void show_status(Session& session, const FrameTimes& times);
/// Above the `foot`, so many pixels high.
void show_notices(Session& session, float foot);

} // namespace anvil

// What goes on: a line of counts and times at the window's foot, and messages above it.
#pragma once

#include "app/viewer/session.h"

namespace anvil {

/// How long the last frames took.
struct FrameTimes {
    double milliseconds = 0;
};

/// Pixels at the window's foot.
float status_height();
void show_status(Session& session, const FrameTimes& times);
void show_notices(Session& session);

} // namespace anvil

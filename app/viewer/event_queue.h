// Events between the window and a frame.
#pragma once

#include "app/viewer/input_event.h"

#include <deque>
#include <vector>

namespace anvil {

/// Panels look at mouse and keys once a frame. What was pressed and released between two frames would never
/// have been, a drag would begin where it has gone to, and Enter would come before what was typed: such
/// events wait for the next frame.
class EventQueue {
  public:
    void add(const std::vector<InputEvent>& events);
    /// Those that one frame can see, in order.
    std::vector<InputEvent> take_frame();
    bool empty() const { return waiting_.empty(); }

  private:
    std::deque<InputEvent> waiting_;
};

} // namespace anvil

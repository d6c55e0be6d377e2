// Dear ImGui's context: fonts, colours, and the window's events as it wants them.
#pragma once

#include "app/viewer/window.h"

namespace anvil {

class Ui {
  public:
    /// `scale`: of fonts and spaces.
    Ui(Window& window, double scale);
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    /// Whether a panel takes the event, so that nobody else should.
    bool handle(const InputEvent& event);
    void begin_frame(WindowSize size, double seconds);
    /// Whether the cursor or a text field of a panel wants more frames soon.
    static bool active();
};

} // namespace anvil

// Panels at a side of the window, one below the other.
#pragma once

namespace anvil {

class PanelColumn {
  public:
    enum class Side { left, right };
    /// Empty, above the window's `foot`, so many pixels high; for one frame.
    PanelColumn(Side side, float foot);

    /// Begins a panel as high as what it holds, at most `share` of the room that is left: then it scrolls.
    /// `open`, if given: it can be closed.
    void begin(const char* title, float share = 1, bool* open = nullptr);
    void end();

    /// Whether the window is large enough for columns at both sides and a view between them.
    static bool has_room();

  private:
    float left_ = 0;
    float top_ = 0;
    float bottom_ = 0;
};

} // namespace anvil

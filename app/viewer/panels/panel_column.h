// Panels at a side of the window, one below the other.
#pragma once

namespace anvil {

class PanelColumn {
  public:
    enum class Side { left, right };
    /// Empty; for one frame.
    explicit PanelColumn(Side side);

    /// Begins a panel as high as what it holds, at most `share` of the room that is left: then it scrolls.
    void begin(const char* title, float share = 1);
    void end();

  private:
    float left_ = 0;
    float top_ = 0;
    float bottom_ = 0;
};

} // namespace anvil

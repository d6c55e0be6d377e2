// Selecting by mouse: a box or a lasso in the window becomes what is asked of the selection.
#pragma once

#include "app/viewer/drag_motion.h"
#include "app/viewer/input_event.h"
#include "app/viewer/selection.h"

#include <optional>
#include <vector>

namespace anvil {

/// What is asked of the selection, as data.
struct SelectionChange {
    enum class Kind : uint8_t {
        region, ///< what lies within the outline, or under its only point
        all,
        none,
        invert,
        grow,
        shrink,
        hide_selected,
        hide_unselected,
        show_all
    };

    Kind kind = Kind::region;
    SelectMode mode = SelectMode::replace;
    bool through = false; ///< also what the surface hides
    OrbitCamera camera;   ///< of the outline
    std::vector<Cursor> outline;
};

class SelectTool {
  public:
    bool lasso = false;   ///< else a box
    bool through = false; ///< also what the surface hides

    /// The left button begins and ends an outline; Shift adds to the selection, Control takes away. Escape
    /// gives it up. Whether the event was the tool's.
    bool handle(const InputEvent& event, const OrbitCamera& camera);

    /// What was asked for since the last call.
    std::optional<SelectionChange> take();
    /// Under way: closed, in the window; empty: none.
    const std::vector<Cursor>& outline() const { return outline_; }

  private:
    void extend(const Cursor& to);
    void finish(const OrbitCamera& camera);

    Cursor cursor_;
    std::vector<Cursor> outline_;
    SelectMode mode_ = SelectMode::replace;
    std::optional<SelectionChange> asked_;
};

/// What a key asks of the selection, if it does.
std::optional<SelectionChange::Kind> selection_key(const InputEvent& event);

} // namespace anvil

// The edits that were taken: each can be changed, and all after it are made again.
#pragma once

#include "app/viewer/panels/edit_details.h"
#include "app/viewer/panels/panel_column.h"
#include "app/viewer/session.h"

namespace anvil {

class EditList {
  public:
    /// A panel of its own, where there are edits.
    void show(Session& session, PanelColumn& column);

  private:
    void show_edit(Session& session, size_t index);
    void order_buttons(Session& session, size_t index);
    void ask(Session& session, const Recipe& next, const std::string& what, const std::string& merge);

    std::optional<size_t> open_;
    EditDetails details_;
    /// What was asked for and is not shown yet: the next change builds on it.
    std::optional<Recipe> draft_;
};

} // namespace anvil

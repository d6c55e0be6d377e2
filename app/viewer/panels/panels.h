// What is laid over the picture: menus, settings, the list of edits, the status bar.
#pragma once

#include "app/viewer/panels/edit_list.h"
#include "app/viewer/panels/edit_panel.h"
#include "app/viewer/panels/file_dialogs.h"
#include "app/viewer/panels/occluder_panel.h"
#include "app/viewer/panels/status_bar.h"

namespace anvil {

/// A frame's panels, between Ui::begin_frame() and ImGui::Render().
class Panels {
  public:
    void show(Session& session, const FrameTimes& times);

    FileDialogs files;

  private:
    EditPanel edit_;
    EditList edits_;
    OccluderPanel occluders_;
};

} // namespace anvil

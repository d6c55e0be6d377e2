// What is laid over the picture: menus, settings, the list of edits, marks of handles, the status bar.
#pragma once

#include "app/viewer/curve_editor.h"
#include "app/viewer/occluder_panel.h"
#include "app/viewer/session.h"

namespace anvil {

/// How long the last frames took.
struct FrameTimes {
    double milliseconds = 0;
};

/// A frame's panels, between Ui::begin_frame() and ImGui::Render().
class Panels {
  public:
    void show(Session& session, const FrameTimes& times);

    /// The person asked to leave, unsaved changes or not.
    bool quit() const { return quit_; }
    void ask_to_quit(const Session& session);
    void ask_to_open() { question_ = FileQuestion::open; }
    void ask_to_save(const Session& session);

  private:
    void menu(Session& session);
    void settings(Session& session);
    void edits(Session& session);
    static void status(Session& session, const FrameTimes& times);
    void notices(Session& session) const;
    void file_dialog(Session& session);
    void quit_dialog(Session& session);
    static void lost_dialog(Session& session);

    enum class FileQuestion : uint8_t { none, open, save_recipe, save_mesh };
    FileQuestion question_ = FileQuestion::none;
    std::string path_;
    CurveEditor curve_;
    OccluderPanel occluders_;
    bool asks_to_quit_ = false;
    bool quit_ = false;
};

} // namespace anvil

// Questions about files: what to open, where to save, what becomes of changes that no file has.
#pragma once

#include "app/viewer/session.h"

namespace anvil {

class FileDialogs {
  public:
    void show(Session& session);

    /// The person asked to leave, unsaved changes or not.
    bool quit() const { return quit_; }
    void ask_to_quit(const Session& session);
    void ask_to_open() { question_ = Question::open; }
    void ask_to_save(const Session& session);
    void ask_to_save_mesh() { question_ = Question::save_mesh; }

  private:
    void file_dialog(Session& session);
    void quit_dialog(Session& session);
    static void lost_dialog(Session& session);

    enum class Question : uint8_t { none, open, save_recipe, save_mesh };
    Question question_ = Question::none;
    std::string path_;
    bool asks_to_quit_ = false;
    bool quit_ = false;
};

} // namespace anvil

// Questions about files: what to open, where to save, what becomes of changes that no file has, where a mesh
// is that a recipe does not find.
#pragma once

#include "app/viewer/panels/file_browser.h"
#include "app/viewer/session.h"

#include <functional>
#include <utility>

namespace anvil {

class FileDialogs {
  public:
    void show(Session& session);

    /// The person asked to leave, unsaved changes or not.
    bool quit() const { return quit_; }
    void ask_to_quit(const Session& session);
    /// Nothing, as all that asks, while another question waits: answered first is what was asked first.
    void ask_to_open();
    /// Asks first if there are unsaved changes.
    void open(Session& session, const std::filesystem::path& file);
    /// Into the recipe's file, if it has one; else asks.
    void save(Session& session);
    void ask_to_save_as(const Session& session);
    void ask_to_save_mesh(const Session& session);
    void ask_to_save_picture(const Session& session);

    /// Files to write a picture of the view alone to.
    std::vector<std::string> take_pictures() { return std::exchange(pictures_, {}); }
    bool wants_picture() const { return !pictures_.empty(); }

  private:
    enum class Question : uint8_t { none, open, missing_mesh, save_recipe, save_mesh, save_picture };

    bool waits() const;
    bool reads() const { return question_ == Question::open || question_ == Question::missing_mesh; }
    static std::vector<std::string> extensions_of(Question question);
    void take_dropped(Session& session);
    void begin(Question question, const std::filesystem::path& file);
    void file_dialog(Session& session);
    void take(Session& session, const std::filesystem::path& file);
    void leave(Session& session);
    void answer(Session& session, const std::filesystem::path& file);
    void overwrite_dialog(Session& session);
    void unsaved_dialog(Session& session);
    void go_on_after_saving(const Session& session);
    static void lost_dialog(Session& session);

    Question question_ = Question::none;
    bool begins_ = false; ///< its window is to be opened
    FileBrowser browser_;
    std::string question_text_;
    std::filesystem::path folder_;                 ///< of the file that was taken last
    std::filesystem::path overwrite_;              ///< is there already; empty: nothing to ask
    std::optional<std::filesystem::path> dropped_; ///< into the dialog, which it answers
    std::function<void()> after_;                  ///< what waits for the answer about unsaved changes
    bool saving_ = false;                          ///< first; then what waits
    std::vector<std::string> pictures_;
    bool quit_ = false;
};

} // namespace anvil

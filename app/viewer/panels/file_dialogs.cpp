#include "app/viewer/panels/file_dialogs.h"

#include "app/viewer/panels/controls.h"

#include <algorithm>
#include <array>
#include <imgui.h>

namespace anvil {

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> mesh_files{".ply", ".obj", ".stl", ".off"};

bool escape_pressed() {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
}

/// `file` with another extension, or the mesh's.
fs::path named_like(const Session& session, const char* extension) {
    const fs::path& recipe = session.shown().recipe_file;
    return fs::path(recipe.empty() ? session.shown().mesh_file : recipe).replace_extension(extension);
}

} // namespace

void FileDialogs::show(Session& session) {
    take_dropped(session);
    if (session.missing_mesh() && !waits()) {
        begin(Question::missing_mesh, session.missing_mesh()->file);
        question_text_ = session.missing_mesh()->text;
    }
    go_on_after_saving(session);
    file_dialog(session);
    overwrite_dialog(session);
    unsaved_dialog(session);
    lost_dialog(session);
}

/// Into a dialog that reads, a file is its answer; into one that writes, what is to be written. Other
/// questions come first.
void FileDialogs::take_dropped(Session& session) {
    if (!overwrite_.empty() || (after_ && !saving_) || !session.lost().empty()) {
        return;
    }
    const auto wanted = session.take_wanted_file();
    if (!wanted) {
        return;
    }
    if (question_ == Question::none) {
        open(session, *wanted);
    } else if (reads()) {
        dropped_ = wanted;
    } else {
        browser_.begin(*wanted, extensions_of(question_), true);
    }
}

/// A window in front of another would leave that one open, unseen, and with it the mouse.
bool FileDialogs::waits() const {
    return question_ != Question::none || !overwrite_.empty() || (after_ && !saving_);
}

std::vector<std::string> FileDialogs::extensions_of(Question question) {
    std::vector<std::string> extensions = mesh_files;
    if (question == Question::open) {
        extensions.emplace_back(".json");
    } else if (question == Question::save_recipe) {
        extensions = {".json"};
    } else if (question == Question::save_picture) {
        extensions = {".png"};
    }
    return extensions;
}

void FileDialogs::begin(Question question, const fs::path& file) {
    if (waits()) {
        return;
    }
    question_ = question;
    browser_.begin(file, extensions_of(question), !reads());
    question_text_.clear();
    begins_ = true;
}

void FileDialogs::ask_to_quit(const Session& session) {
    if (session.unsaved()) {
        after_ = [this] { quit_ = true; };
    } else {
        quit_ = true;
    }
}

void FileDialogs::ask_to_open() {
    begin(Question::open, folder_);
}

void FileDialogs::open(Session& session, const fs::path& file) {
    if (session.unsaved()) {
        after_ = [&session, file] { session.open(file); };
    } else {
        session.open(file);
    }
}

void FileDialogs::save(Session& session) {
    if (session.shown().mesh && !session.shown().recipe_file.empty()) {
        session.save(session.shown().recipe_file);
    } else {
        ask_to_save_as(session);
    }
}

void FileDialogs::ask_to_save_as(const Session& session) {
    if (session.shown().mesh) {
        begin(Question::save_recipe, named_like(session, ".json"));
    }
}

void FileDialogs::ask_to_save_mesh(const Session& session) {
    if (session.shown().mesh) {
        begin(Question::save_mesh, named_like(session, ".forged.ply"));
    }
}

void FileDialogs::ask_to_save_picture(const Session& session) {
    if (session.shown().mesh) {
        begin(Question::save_picture, named_like(session, ".png"));
    }
}

void FileDialogs::file_dialog(Session& session) {
    if (question_ == Question::none) {
        return;
    }
    constexpr std::array titles{"",
                                "Open a mesh or a recipe",
                                "Where is the mesh of this recipe?",
                                "Save the recipe (.json)",
                                "Save the mesh (.ply, .obj, .stl, .off)",
                                "Save a picture (.png)"};
    const char* title = titles[static_cast<size_t>(question_)];
    if (std::exchange(begins_, false) || (overwrite_.empty() && !ImGui::IsPopupOpen(title))) {
        ImGui::OpenPopup(title);
    }
    ImGui::SetNextWindowSize(ImVec2(std::min(620 * unit(), ImGui::GetIO().DisplaySize.x), 0));
    if (!ImGui::BeginPopupModal(title, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
        return;
    }
    if (!question_text_.empty()) {
        ImGui::TextWrapped("%s", question_text_.c_str());
    }
    std::optional<fs::path> taken = browser_.show();
    if (ImGui::Button(reads() ? "Open" : "Save") && !taken) {
        taken = browser_.take();
    }
    if (dropped_) {
        taken = std::exchange(dropped_, std::nullopt);
    }
    ImGui::SameLine();
    const bool left = ImGui::Button("Cancel") || escape_pressed();
    if (taken || left) {
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
    if (taken) {
        take(session, *taken);
    } else if (left) {
        leave(session);
    }
}

void FileDialogs::take(Session& session, const fs::path& file) {
    std::error_code failed;
    if (!reads() && fs::exists(file, failed)) {
        overwrite_ = file;
    } else {
        answer(session, file);
    }
}

void FileDialogs::leave(Session& session) {
    if (question_ == Question::missing_mesh) {
        session.leave_missing_mesh();
    }
    question_ = Question::none;
    if (std::exchange(saving_, false)) { // what waits for it stays undone too
        after_ = nullptr;
    }
}

void FileDialogs::answer(Session& session, const fs::path& file) {
    folder_ = file.parent_path();
    switch (std::exchange(question_, Question::none)) {
    case Question::open:
        open(session, file);
        break;
    case Question::missing_mesh:
        session.take_missing_mesh(file);
        break;
    case Question::save_recipe:
    case Question::save_mesh:
        session.save(file);
        break;
    case Question::save_picture:
        pictures_.push_back(file.string());
        break;
    case Question::none:
        break;
    }
}

void FileDialogs::overwrite_dialog(Session& session) {
    if (overwrite_.empty()) {
        return;
    }
    ImGui::OpenPopup("It is there already");
    if (ImGui::BeginPopupModal("It is there already", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
        ImGui::TextUnformatted(overwrite_.string().c_str());
        const bool replaces = ImGui::Button("Replace it");
        ImGui::SameLine();
        const bool goes_back = ImGui::Button("Another name") || escape_pressed();
        if (replaces || goes_back) {
            ImGui::CloseCurrentPopup();
        }
        ImGui::EndPopup();
        if (replaces) {
            answer(session, std::exchange(overwrite_, {}));
        } else if (goes_back) {
            overwrite_.clear();
            begins_ = true;
        }
    }
}

/// What waits for the changes to be saved goes on once they are, and not at all if that failed.
void FileDialogs::go_on_after_saving(const Session& session) {
    if (saving_ && question_ == Question::none && overwrite_.empty() && session.settled()) {
        saving_ = false;
        if (const auto after = std::exchange(after_, nullptr); after && !session.unsaved()) {
            after();
        }
    }
}

void FileDialogs::unsaved_dialog(Session& session) {
    if (!after_ || saving_ || question_ != Question::none) {
        return;
    }
    ImGui::OpenPopup("Unsaved changes");
    if (ImGui::BeginPopupModal("Unsaved changes", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
        ImGui::TextUnformatted("The recipe has changes that no file has.");
        const bool saves = ImGui::Button("Save");
        ImGui::SameLine();
        const bool loses = ImGui::Button("Go on without saving");
        ImGui::SameLine();
        const bool stays = ImGui::Button("Stay") || escape_pressed();
        if (saves || loses || stays) {
            ImGui::CloseCurrentPopup();
        }
        ImGui::EndPopup();
        if (saves) {
            saving_ = true;
            if (session.moves()) { // what is under way is part of it
                session.commit();
            }
            save(session);
        } else if (loses || stays) {
            const auto after = std::exchange(after_, nullptr);
            if (loses) {
                after();
            }
        }
    }
}

void FileDialogs::lost_dialog(Session& session) {
    if (session.lost().empty()) {
        return;
    }
    const LostSession& lost = *session.lost().front();
    ImGui::OpenPopup("A session ended unsaved");
    if (ImGui::BeginPopupModal("A session ended unsaved", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
        const std::string name = lost.recipe.file.empty() ? lost.recipe.mesh : lost.recipe.file;
        ImGui::TextUnformatted(
            (name + "\n" + std::to_string(lost.recipe.edits.size()) + " edits, last kept " + lost.time)
                .c_str());
        const bool recovers = ImGui::Button("Recover");
        ImGui::SameLine();
        const bool forgets = ImGui::Button("Delete");
        ImGui::SameLine();
        const bool leaves = ImGui::Button("Ask next time");
        if (recovers || forgets || leaves) {
            ImGui::CloseCurrentPopup();
        }
        if (recovers) {
            session.recover();
        } else if (forgets) {
            session.forget_lost();
        } else if (leaves) {
            session.leave_lost();
        }
        ImGui::EndPopup();
    }
}

} // namespace anvil

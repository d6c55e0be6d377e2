#include "app/viewer/panels/file_dialogs.h"

#include <imgui.h>
#include <imgui_stdlib.h>

namespace anvil {

void FileDialogs::show(Session& session) {
    file_dialog(session);
    quit_dialog(session);
    lost_dialog(session);
}

void FileDialogs::ask_to_quit(const Session& session) {
    if (session.shown().document.unsaved) {
        asks_to_quit_ = true;
    } else {
        quit_ = true;
    }
}

void FileDialogs::ask_to_save(const Session& session) {
    if (session.shown().mesh) {
        question_ = Question::save_recipe;
        path_ = session.shown().recipe_file.string();
    }
}

void FileDialogs::file_dialog(Session& session) {
    if (question_ == Question::none) {
        return;
    }
    const bool opens = question_ == Question::open;
    const char* title = opens                                ? "Open a mesh or a recipe"
                        : question_ == Question::save_recipe ? "Save the recipe (.json)"
                                                             : "Save the mesh (.ply, .obj, .stl, .off)";
    ImGui::OpenPopup(title);
    ImGui::SetNextWindowSize(ImVec2(560, 0));
    if (ImGui::BeginPopupModal(title, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
        if (ImGui::IsWindowAppearing()) {
            ImGui::SetKeyboardFocusHere();
        }
        const bool entered = ImGui::InputText("file", &path_, ImGuiInputTextFlags_EnterReturnsTrue);
        const bool taken = ImGui::Button(opens ? "Open" : "Save") || entered;
        ImGui::SameLine();
        const bool left = ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
        if (taken && !path_.empty()) {
            if (opens) {
                session.open(path_);
            } else {
                session.save(path_);
            }
        }
        if (taken || left) {
            question_ = Question::none;
            ImGui::CloseCurrentPopup();
        }
        ImGui::EndPopup();
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

void FileDialogs::quit_dialog(Session& session) {
    if (!asks_to_quit_) {
        return;
    }
    ImGui::OpenPopup("Unsaved changes");
    if (ImGui::BeginPopupModal("Unsaved changes", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
        ImGui::TextUnformatted("The recipe has changes that no file has.");
        if (ImGui::Button("Save...")) {
            asks_to_quit_ = false;
            ask_to_save(session);
        }
        ImGui::SameLine();
        quit_ = ImGui::Button("Leave without saving");
        ImGui::SameLine();
        if (ImGui::Button("Stay")) {
            asks_to_quit_ = false;
        }
        if (!asks_to_quit_ || quit_) {
            ImGui::CloseCurrentPopup();
        }
        ImGui::EndPopup();
    }
}

} // namespace anvil

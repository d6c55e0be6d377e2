#include "app/viewer/panels/select_menu.h"

#include <array>
#include <imgui.h>

namespace anvil {

namespace {

struct Command {
    const char* name;
    const char* key;
    SelectionChange::Kind kind;
};

using Kind = SelectionChange::Kind;
constexpr std::array commands{Command{"All", "Ctrl+A", Kind::all},
                              Command{"None", "Ctrl+Shift+A", Kind::none},
                              Command{"Invert", "Ctrl+I", Kind::invert},
                              Command{"Grow", "+", Kind::grow},
                              Command{"Shrink", "-", Kind::shrink},
                              Command{"Hide selected", "H", Kind::hide_selected},
                              Command{"Hide others", "Shift+H", Kind::hide_unselected},
                              Command{"Show all", "Alt+H", Kind::show_all}};

void tools(Session& session) {
    const bool selects = session.editor.tool == Tool::select;
    if (ImGui::MenuItem("Box", "B", selects && !session.select.lasso)) {
        session.editor.tool = Tool::select;
        session.select.lasso = false;
    }
    if (ImGui::MenuItem("Lasso", "Shift+B", selects && session.select.lasso)) {
        session.editor.tool = Tool::select;
        session.select.lasso = true;
    }
    ImGui::MenuItem("Through the surface", "V", &session.select.through);
}

} // namespace

void select_menu(Session& session) {
    if (!ImGui::BeginMenu("Select", session.shown().mesh != nullptr)) {
        return;
    }
    tools(session);
    ImGui::Separator();
    for (const Command& command : commands) {
        if (ImGui::MenuItem(command.name, command.key)) {
            session.change_selection(command.kind);
        }
    }
    ImGui::Separator();
    const bool any = session.shown().look->selected_count > 0;
    if (ImGui::MenuItem("Pin for all edits", "Ctrl+P", false, any)) {
        session.pin_selection();
    }
    if (ImGui::MenuItem("Unpin", "Ctrl+Shift+P", false, !session.editor.lasting_pins().empty())) {
        session.editor.set_lasting_pins({});
    }
    if (ImGui::MenuItem("Anchors of the handle", "Shift+A", false, any && session.editor.has_handles())) {
        session.anchor_selection();
    }
    if (ImGui::MenuItem("Show in the window", "F", false, any)) {
        session.frame_selection();
    }
    ImGui::EndMenu();
}

} // namespace anvil

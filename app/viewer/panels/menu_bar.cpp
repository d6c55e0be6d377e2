#include "app/viewer/panels/menu_bar.h"

#include "app/viewer/panels/select_menu.h"

#include <imgui.h>

namespace anvil {

namespace {

void file_menu(Session& session, FileDialogs& files) {
    if (ImGui::BeginMenu("File")) {
        const bool open = session.shown().mesh != nullptr;
        if (ImGui::IsWindowAppearing()) {
            session.look_for_recent();
        }
        if (ImGui::MenuItem("Open mesh or recipe...", "Ctrl+O")) {
            files.ask_to_open();
        }
        if (ImGui::BeginMenu("Open again", !session.recent().empty())) {
            for (const std::filesystem::path& file : session.recent()) {
                if (ImGui::MenuItem(file.string().c_str())) {
                    files.open(session, file);
                    break; // the list is another one then
                }
            }
            ImGui::EndMenu();
        }
        if (ImGui::MenuItem("Save recipe", "Ctrl+S", false, open)) {
            files.save(session);
        }
        if (ImGui::MenuItem("Save recipe as...", "Ctrl+Shift+S", false, open)) {
            files.ask_to_save_as(session);
        }
        if (ImGui::MenuItem("Save mesh as...", nullptr, false, open)) {
            files.ask_to_save_mesh(session);
        }
        if (ImGui::MenuItem("Save picture as...", "F12", false, open)) {
            files.ask_to_save_picture(session);
        }
        if (ImGui::MenuItem("Quit")) {
            files.ask_to_quit(session);
        }
        ImGui::EndMenu();
    }
}

void edit_menu(Session& session) {
    const DocumentState& document = session.shown().document;
    if (ImGui::BeginMenu("Edit")) {
        const auto item = [](const char* name, const std::string& what, const char* key) {
            return ImGui::MenuItem((name + (what.empty() ? "" : " " + what)).c_str(), key, false,
                                   !what.empty());
        };
        if (item("Undo", document.undo, "Ctrl+Z")) {
            session.undo();
        }
        if (item("Redo", document.redo, "Ctrl+Shift+Z")) {
            session.redo();
        }
        ImGui::EndMenu();
    }
}

void view_menu(Session& session) {
    if (ImGui::BeginMenu("View")) {
        ImGui::MenuItem("Edges", "W", &session.view.edges);
        ImGui::MenuItem("Flat shading", "S", &session.view.flat);
        ImGui::MenuItem("Colours of the region", nullptr, &session.view.tint);
        ImGui::MenuItem("Lines of equal distance", "I", &session.view.contours);
        ImGui::MenuItem("Occluders", nullptr, &session.view.occluders);
        if (ImGui::BeginMenu("Light")) {
            for (const auto& [name, lights] : light_names()) {
                if (ImGui::MenuItem(name, nullptr, session.view.lights == lights)) {
                    session.view.lights = lights;
                }
            }
            ImGui::EndMenu();
        }
        bool z_up = session.camera.upright() == UpAxis::z;
        if (ImGui::MenuItem("Z points up", nullptr, &z_up)) {
            session.set_up(z_up ? UpAxis::z : UpAxis::y);
        }
        ImGui::MenuItem("Parallel view", "5", &session.camera.orthographic);
        ImGui::MenuItem("Trackball", "T", &session.camera.trackball);
        bool maya = session.navigation.preset == MousePreset::maya;
        if (ImGui::MenuItem("Mouse as in Maya", nullptr, &maya)) {
            session.navigation.preset = maya ? MousePreset::maya : MousePreset::blender;
        }
        ImGui::MenuItem("Less detail in motion", nullptr, &session.view.less_in_motion);
        ImGui::MenuItem("Mesh and times", "F2", &session.view.facts);
        ImGui::MenuItem("Panels", "Tab", &session.view.panels);
        ImGui::EndMenu();
    }
}

void device_menu(Session& session) {
    if (ImGui::BeginMenu("Device")) {
        const std::vector<std::string>& names = session.device_choices();
        for (size_t i = 0; i < names.size(); ++i) {
            if (ImGui::MenuItem(names[i].c_str(), session.driver_of(i).c_str(),
                                names[i] == session.shown().device)) {
                session.use_device(names[i]);
            }
        }
        ImGui::EndMenu();
    }
}

void help_menu(Session& session) {
    if (ImGui::BeginMenu("Help")) {
        ImGui::MenuItem("Keys", "F1", &session.view.help);
        ImGui::EndMenu();
    }
}

} // namespace

void show_menu(Session& session, FileDialogs& files) {
    if (!ImGui::BeginMainMenuBar()) {
        return;
    }
    file_menu(session, files);
    edit_menu(session);
    select_menu(session);
    view_menu(session);
    device_menu(session);
    help_menu(session);
    ImGui::EndMainMenuBar();
}

} // namespace anvil

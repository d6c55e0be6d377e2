#include "app/viewer/panels.h"

#include "engine/core/number_text.h"

#include <array>
#include <imgui.h>
#include <imgui_stdlib.h>

namespace anvil {

namespace {

constexpr float side_width = 290;
const ImVec4 error_colour(1.0F, 0.55F, 0.45F, 1);
const ImVec4 warning_colour(1.0F, 0.85F, 0.5F, 1);

constexpr const char* key_help =
    "Surface\n"
    "  drag                 move the point under the cursor (turn it, with the turn tool)\n"
    "  Shift+click          another handle\n"
    "  G / R                move / turn tool; with handles: move or turn them until Enter or a click\n"
    "  A / P                clicks set anchors of the handle / pins\n"
    "  Enter / Esc          take / drop the edit\n"
    "While dragging\n"
    "  X Y Z N              along an axis or the normal; with Shift: in the plane across it\n"
    "  digits - .           a length or an angle\n"
    "  wheel                radius\n"
    "  Ctrl / Shift         snap / move precisely\n"
    "  Enter / Esc, right   take / cancel\n"
    "View\n"
    "  middle, Alt+left     turn        Shift+middle, Alt+middle   move\n"
    "  wheel                zoom to the cursor (Ctrl+wheel with handles: radius)\n"
    "  1 3 7, with Shift    front right top, back left bottom     5   parallel view\n"
    "  F, Home              show all    T   trackball or turntable\n"
    "  W S I                edges, flat shading, lines of equal distance\n"
    "  D                    distances along the surface or straight\n"
    "Curve\n"
    "  drag a knot or the end of its slope (Alt: one side, a kink)\n"
    "  double click: a new knot     right click: without it\n"
    "Program\n"
    "  Ctrl+Z, Ctrl+Shift+Z undo, redo\n"
    "  Ctrl+O, Ctrl+S       open, save the recipe     Tab   panels     F1   this help\n";

/// A slider for lengths from a thousandth of `size` to all of it.
bool length_slider(const char* label, double& value, double size) {
    auto number = static_cast<float>(value);
    const bool changed = ImGui::SliderFloat(label, &number, static_cast<float>(1e-3 * size),
                                            static_cast<float>(size), "%.4g", ImGuiSliderFlags_Logarithmic);
    if (changed) {
        value = number;
    }
    return changed;
}

bool shape_combo(const char* label, ShapeChoice& shape) {
    bool changed = false;
    const std::string now = shape.preset.empty() ? "own curve" : shape.preset;
    if (ImGui::BeginCombo(label, now.c_str())) {
        for (const std::string& name : preset_names()) {
            if (ImGui::Selectable(name.c_str(), name == shape.preset)) {
                shape = {name, {}};
                changed = true;
            }
        }
        ImGui::EndCombo();
    }
    return changed;
}

} // namespace

void Panels::ask_to_quit(const Session& session) {
    if (session.shown().document.unsaved) {
        asks_to_quit_ = true;
    } else {
        quit_ = true;
    }
}

void Panels::ask_to_save(const Session& session) {
    if (session.shown().mesh) {
        question_ = FileQuestion::save_recipe;
        path_ = session.shown().recipe_file.string();
    }
}

void Panels::show(Session& session, const FrameTimes& times) {
    menu(session);
    if (session.view.panels) {
        settings(session);
        edits(session);
        occluders_.show(session);
    }
    status(session, times);
    notices(session);
    file_dialog(session);
    quit_dialog(session);
    lost_dialog(session);
    if (session.view.help) {
        ImGui::SetNextWindowPos(ImVec2(ImGui::GetIO().DisplaySize.x / 2, ImGui::GetIO().DisplaySize.y / 2),
                                ImGuiCond_Always, ImVec2(0.5F, 0.5F));
        ImGui::Begin("Keys", &session.view.help,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
        ImGui::TextUnformatted(key_help);
        ImGui::End();
    }
}

void Panels::menu(Session& session) {
    const DocumentState& document = session.shown().document;
    if (!ImGui::BeginMainMenuBar()) {
        return;
    }
    if (ImGui::BeginMenu("File")) {
        const bool open = session.shown().mesh != nullptr;
        if (ImGui::MenuItem("Open mesh or recipe...", "Ctrl+O")) {
            ask_to_open();
        }
        if (ImGui::BeginMenu("Open again", !session.recent().empty())) {
            for (const std::filesystem::path& file : session.recent()) {
                if (ImGui::MenuItem(file.string().c_str())) {
                    session.open(file);
                    break; // the list is another one then
                }
            }
            ImGui::EndMenu();
        }
        if (ImGui::MenuItem("Save recipe", "Ctrl+S", false, open)) {
            ask_to_save(session);
        }
        if (ImGui::MenuItem("Save mesh as...", nullptr, false, open)) {
            question_ = FileQuestion::save_mesh;
        }
        if (ImGui::MenuItem("Quit")) {
            ask_to_quit(session);
        }
        ImGui::EndMenu();
    }
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
    if (ImGui::BeginMenu("View")) {
        ImGui::MenuItem("Edges", "W", &session.view.edges);
        ImGui::MenuItem("Flat shading", "S", &session.view.flat);
        ImGui::MenuItem("Colours of the region", nullptr, &session.view.tint);
        ImGui::MenuItem("Lines of equal distance", "I", &session.view.contours);
        ImGui::MenuItem("Occluders", nullptr, &session.view.occluders);
        ImGui::MenuItem("Parallel view", "5", &session.camera.orthographic);
        ImGui::MenuItem("Trackball", "T", &session.camera.trackball);
        bool maya = session.navigation.preset == MousePreset::maya;
        if (ImGui::MenuItem("Mouse as in Maya", nullptr, &maya)) {
            session.navigation.preset = maya ? MousePreset::maya : MousePreset::blender;
        }
        ImGui::MenuItem("Panels", "Tab", &session.view.panels);
        ImGui::EndMenu();
    }
    if (ImGui::BeginMenu("Device")) {
        for (const std::string& name : session.device_choices()) {
            if (ImGui::MenuItem(name.c_str(), nullptr, name == session.shown().device)) {
                session.use_device(name);
            }
        }
        ImGui::EndMenu();
    }
    if (ImGui::BeginMenu("Help")) {
        ImGui::MenuItem("Keys", "F1", &session.view.help);
        ImGui::EndMenu();
    }
    ImGui::EndMainMenuBar();
}

void Panels::settings(Session& session) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(window.x - side_width - 8, 30), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints(ImVec2(side_width, 0), ImVec2(side_width, window.y));
    ImGui::Begin("Edit", nullptr, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize);
    Editor& editor = session.editor;
    constexpr std::array<std::pair<const char*, Tool>, 4> tools{
        {{"Move", Tool::move}, {"Turn", Tool::turn}, {"Anchor", Tool::anchor}, {"Pin", Tool::pin}}};
    for (const auto& [name, tool] : tools) {
        if (ImGui::RadioButton(name, editor.tool == tool)) {
            editor.tool = tool;
        }
        if (tool != Tool::pin) {
            ImGui::SameLine();
        }
    }
    const double diagonal = std::max(session.bounds().diagonal(), 1e-30);
    bool changed = length_slider("radius", editor.radius, diagonal);
    changed = shape_combo("shape", editor.shape) || changed;
    changed = curve_.show(editor.shape) || changed;
    int metric = editor.metric == Metric::euclidean ? 1 : 0;
    if (ImGui::Combo("distance", &metric, "along the surface\0straight\0")) {
        editor.metric = metric == 1 ? Metric::euclidean : Metric::geodesic;
        changed = true;
    }
    bool refines = editor.refine.has_value();
    if (ImGui::Checkbox("refine", &refines)) {
        editor.refine = refines ? std::optional(Refine{}) : std::nullopt;
        changed = true;
    }
    if (editor.refine) {
        changed = length_slider("tolerance", editor.refine->shape_tolerance, 0.1) || changed;
    }
    if (changed) {
        editor.settings_changed();
    }
    if (editor.has_handles()) {
        if (ImGui::Button("Take (Enter)")) {
            session.commit();
        }
        ImGui::SameLine();
        if (ImGui::Button("Drop (Esc)")) {
            session.drop();
        }
    }
    ImGui::End();
}

void Panels::edits(Session& session) {
    const DocumentState& document = session.shown().document;
    if (!document.recipe || document.recipe->edits.empty()) {
        return;
    }
    ImGui::SetNextWindowPos(ImVec2(8, 30), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints(ImVec2(side_width, 0),
                                        ImVec2(side_width, ImGui::GetIO().DisplaySize.y));
    ImGui::Begin("Edits", nullptr, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize);
    const double diagonal = std::max(session.bounds().diagonal(), 1e-30);
    for (size_t i = 0; i < document.recipe->edits.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        Edit edit = document.recipe->edits[i];
        const std::string title =
            std::to_string(i + 1) + ". " + (edit.kind == EditKind::rotate ? "turn" : "move") + ", " +
            std::to_string(edit.handles.size()) + (edit.handles.size() == 1 ? " handle" : " handles");
        if (ImGui::TreeNode(title.c_str())) {
            double radius = edit.radius.value_or(0.25 * diagonal);
            bool changed = length_slider("radius", radius, diagonal);
            edit.radius = changed ? std::optional(radius) : edit.radius;
            auto amount = static_cast<float>(edit.amount);
            if (ImGui::SliderFloat("amount", &amount, 0, 1)) {
                edit.amount = amount;
                changed = true;
            }
            changed = shape_combo("shape", edit.shape) || changed;
            const bool remove = ImGui::Button("Remove");
            if (changed || remove) {
                Recipe next = *document.recipe;
                const auto place = next.edits.begin() + static_cast<std::ptrdiff_t>(i);
                if (remove) {
                    next.edits.erase(place);
                } else {
                    *place = edit;
                }
                session.change(next, remove ? "removal of an edit" : "change of an edit",
                               remove ? "" : "edit " + std::to_string(i));
            }
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
    ImGui::End();
}

void Panels::status(Session& session, const FrameTimes& times) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float height = 2 * ImGui::GetTextLineHeightWithSpacing() + 8;
    ImGui::SetNextWindowPos(ImVec2(0, window.y - height));
    ImGui::SetNextWindowSize(ImVec2(window.x, height));
    ImGui::Begin("status", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::TextUnformatted(session.editor.hint().c_str());
    const Shown& shown = session.shown();
    std::string line = "nothing is open: File, Open, or drop a file here";
    if (shown.mesh) {
        const SurfaceVersion& surface = *shown.document.surface;
        const Vec3 extent = session.bounds().high - session.bounds().low;
        line = shown.mesh_file.filename().string() + (shown.document.unsaved ? " (unsaved)" : "") + "   " +
               std::to_string(surface.mesh->vertex_count()) + " vertices, " +
               std::to_string(surface.mesh->polygon_count()) + " faces   " + rounded_text(extent.x) + " x " +
               rounded_text(extent.y) + " x " + rounded_text(extent.z);
        if (shown.drag) {
            line += "   region " + std::to_string(shown.drag->region) + ", condition " +
                    rounded_text(shown.drag->condition) + ", step " +
                    rounded_text(std::round(shown.drag->milliseconds * 10) / 10) + " ms";
        }
    }
    line +=
        "   " + shown.device + "   " + rounded_text(std::round(times.milliseconds * 10) / 10) + " ms a frame";
    ImGui::TextUnformatted(line.c_str());
    const WorkerState work = session.work();
    if (!work.job.empty() && work.seconds > 0.3) {
        ImGui::SameLine(window.x - 330);
        const std::string text = work.job + (work.stage.empty() ? "" : ": " + work.stage);
        ImGui::ProgressBar(static_cast<float>(work.fraction), ImVec2(240, 0), text.c_str());
        ImGui::SameLine();
        if (ImGui::SmallButton("Cancel")) {
            session.cancel_work();
        }
    }
    ImGui::End();
}

void Panels::notices(Session& session) const {
    if (session.notices().empty()) {
        return;
    }
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(8, window.y - 60), ImGuiCond_Always, ImVec2(0, 1));
    ImGui::SetNextWindowSizeConstraints(ImVec2(300, 0), ImVec2(window.x * 0.7F, window.y * 0.5F));
    bool open = true;
    ImGui::Begin("Messages", &open,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushTextWrapPos(window.x * 0.65F);
    for (const Notice& notice : session.notices()) {
        ImGui::PushStyleColor(ImGuiCol_Text, notice.is_error ? error_colour : warning_colour);
        ImGui::TextUnformatted(notice.text.c_str());
        ImGui::PopStyleColor();
    }
    ImGui::PopTextWrapPos();
    ImGui::End();
    if (!open) {
        session.dismiss_notices();
    }
}

void Panels::file_dialog(Session& session) {
    if (question_ == FileQuestion::none) {
        return;
    }
    const bool opens = question_ == FileQuestion::open;
    const char* title = opens                                    ? "Open a mesh or a recipe"
                        : question_ == FileQuestion::save_recipe ? "Save the recipe (.json)"
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
            question_ = FileQuestion::none;
            ImGui::CloseCurrentPopup();
        }
        ImGui::EndPopup();
    }
}

void Panels::lost_dialog(Session& session) {
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

void Panels::quit_dialog(Session& session) {
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

#include "app/viewer/panels/edit_panel.h"

#include "app/viewer/panels/controls.h"
#include "app/viewer/panels/mirror_controls.h"

#include <array>
#include <imgui.h>

namespace anvil {

void EditPanel::show(Session& session, PanelColumn& column) {
    column.begin("Edit", 0.65F);
    Editor& editor = session.editor;
    constexpr std::array<std::pair<const char*, Tool>, 6> tools{{{"Move", Tool::move},
                                                                 {"Turn", Tool::turn},
                                                                 {"Anchor", Tool::anchor},
                                                                 {"Pin", Tool::pin},
                                                                 {"Line", Tool::line},
                                                                 {"Select", Tool::select}}};
    for (const auto& [name, tool] : tools) {
        if (ImGui::RadioButton(name, editor.tool == tool)) {
            editor.tool = tool;
        }
        if (tool != Tool::pin && tool != Tool::select) {
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
    changed = mirror_controls(editor.mirror, session.bounds()) || changed;
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
    column.end();
}

} // namespace anvil

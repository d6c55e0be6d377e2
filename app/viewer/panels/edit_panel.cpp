#include "app/viewer/panels/edit_panel.h"

#include "app/viewer/panels/controls.h"
#include "app/viewer/panels/mirror_controls.h"
#include "app/viewer/panels/refine_controls.h"

#include <array>
#include <imgui.h>

namespace anvil {

void EditPanel::show(Session& session, PanelColumn& column) {
    column.begin("Edit", 0.65F);
    ImGui::PushItemWidth(-80 * unit());
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
    changed = refine_controls(editor.refine, diagonal) || changed;
    if (session.shown().outcome && session.shown().outcome->report.refine) {
        show_refinement(*session.shown().outcome->report.refine, session.shown().outcome->vertices);
    }
    ImGui::Checkbox("follow the path of the drag", &editor.follow_path);
    changed = mirror_controls(editor.mirror, session.bounds()) || changed;
    if (changed) {
        session.options_changed();
    }
    if (session.has_pending()) {
        if (ImGui::Button("Take (Enter)")) {
            session.commit();
        }
        ImGui::SameLine();
        if (ImGui::Button("Drop (Esc)")) {
            session.drop();
        }
    }
    ImGui::PopItemWidth();
    column.end();
}

} // namespace anvil

#include "app/viewer/panels/edit_list.h"

#include "app/viewer/panels/controls.h"

#include <imgui.h>

namespace anvil {

void show_edit_list(Session& session, PanelColumn& column) {
    const DocumentState& document = session.shown().document;
    if (!document.recipe || document.recipe->edits.empty()) {
        return;
    }
    column.begin("Edits");
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
    column.end();
}

} // namespace anvil

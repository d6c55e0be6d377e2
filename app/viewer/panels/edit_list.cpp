#include "app/viewer/panels/edit_list.h"

#include "app/viewer/panels/controls.h"

#include <imgui.h>

namespace anvil {

namespace {

std::string title_of(const Edit& edit, size_t index) {
    const std::string number = std::to_string(index + 1) + ". ";
    if (edit.handles.empty()) {
        return number + "hammer";
    }
    return number + (edit.kind == EditKind::rotate ? "turn" : "move") + ", " +
           std::to_string(edit.handles.size()) + (edit.handles.size() == 1 ? " handle" : " handles") +
           (edit.refine ? ", refined" : "");
}

} // namespace

void EditList::ask(Session& session, const Recipe& next, const std::string& what, const std::string& merge) {
    draft_ = next;
    session.change(next, what, merge);
}

void EditList::order_buttons(Session& session, size_t index) {
    Recipe next = *draft_;
    const auto place = next.edits.begin() + static_cast<std::ptrdiff_t>(index);
    if (ImGui::Button("Remove")) {
        next.edits.erase(place);
        open_.reset();
        return ask(session, next, "removal of an edit", "");
    }
    ImGui::SameLine();
    if (ImGui::Button("Earlier") && index > 0) {
        std::iter_swap(place, place - 1);
        open_ = index - 1;
        return ask(session, next, "order of edits", "");
    }
    ImGui::SameLine();
    if (ImGui::Button("Later") && index + 1 < next.edits.size()) {
        std::iter_swap(place, place + 1);
        open_ = index + 1;
        return ask(session, next, "order of edits", "");
    }
}

void EditList::show_edit(Session& session, size_t index) {
    ImGui::PushID(static_cast<int>(index));
    ImGui::SetNextItemOpen(open_ == index);
    const bool opens = ImGui::TreeNode(title_of(draft_->edits[index], index).c_str());
    if (ImGui::IsItemClicked()) {
        open_ = open_ == index ? std::nullopt : std::optional(index);
    }
    if (opens) {
        Edit edit = draft_->edits[index];
        if (details_.show(edit, session.bounds())) {
            Recipe next = *draft_;
            next.edits[index] = edit;
            ask(session, next, "change of an edit", "edit " + std::to_string(index));
        }
        order_buttons(session, index);
        ImGui::TreePop();
    }
    ImGui::PopID();
}

void EditList::show(Session& session, PanelColumn& column) {
    const DocumentState& document = session.shown().document;
    if (!draft_ || session.settled()) {
        draft_ = document.recipe ? std::optional(*document.recipe) : std::nullopt;
    }
    if (!draft_ || draft_->edits.empty()) {
        draft_.reset();
        return;
    }
    column.begin("Edits", session.view.facts ? 0.5F : 1.0F);
    ImGui::PushItemWidth(-110 * unit());
    for (size_t i = 0; i < draft_->edits.size(); ++i) { // a removal ends it sooner
        show_edit(session, i);
    }
    ImGui::PopItemWidth();
    column.end();
}

} // namespace anvil

#include "app/viewer/panels/occluder_panel.h"

#include "app/viewer/panels/controls.h"
#include "app/viewer/panels/occluder_controls.h"

#include <imgui.h>
#include <imgui_stdlib.h>

namespace anvil {

namespace {

void show_hammer(Session& session) {
    ImGui::Checkbox("record motion (hammer)", &session.occluders.records);
    const auto motions = session.occluders.motions();
    if (motions.empty()) {
        return;
    }
    for (const auto& [name, motion] : motions) {
        ImGui::Text("%s: %zu poses", name.c_str(), motion.size());
    }
    if (ImGui::Checkbox("only within the radius of the strike", &session.options.near_strike)) {
        session.options_changed();
    }
    if (ImGui::Button("Forget the motion")) {
        session.drop();
    }
}

/// Of what is under way, else of the last edit.
void show_contacts(const Session& session) {
    const Shown& shown = session.shown();
    if (shown.outcome) { // with what swells up, and finished by exact distances
        show_contact(shown.outcome->report);
        if (shown.outcome->report.volume) {
            show_volume(shown.outcome->report.volume->before, shown.outcome->report.volume->after);
        }
    } else if (shown.drag && !shown.drag->contact) {
        ImGui::TextUnformatted("touching: being measured");
    } else if (shown.drag) {
        show_live_contact(shown.drag->contact->touching);
        if (shown.drag->contact->volume) {
            show_volume((*shown.drag->contact->volume)[0], (*shown.drag->contact->volume)[1]);
        }
    } else if (shown.standing) {
        show_live_contact(*shown.standing);
    } else {
        const EditReport& report = shown.document.surface->report;
        show_contact(report);
        if (report.volume) {
            show_volume(report.volume->before, report.volume->after);
        }
    }
}

} // namespace

void OccluderPanel::add(Session& session) {
    const std::vector<std::string> kinds = occluder_kinds();
    std::string list;
    for (const std::string& kind : kinds) {
        list += kind + '\0';
    }
    list += std::string("from a file") + '\0';
    ImGui::Combo("##kind", &shape_, list.c_str());
    const bool from_file = shape_ == static_cast<int>(kinds.size());
    if (from_file) {
        ImGui::InputText("file", &file_);
    }
    ImGui::SameLine();
    if (ImGui::Button("Add") && (!from_file || !file_.empty())) {
        Recipe next = *session.shown().document.recipe;
        next.occluders.push_back(
            new_occluder(next, from_file ? file_ : kinds[static_cast<size_t>(shape_)], session.bounds()));
        session.change(next, "new occluder");
        session.occluders.select(next.occluders.back().name);
    }
}

void OccluderPanel::show_settings(Session& session, size_t index) {
    Recipe next = *session.shown().document.recipe;
    Occluder& occluder = next.occluders[index];
    const std::string name = occluder.name;
    const double size = std::max(session.bounds().diagonal(), 1e-30);
    const bool moved = transform_controls(occluder.transform, size);
    const bool changed = influence_controls(occluder.influence, size, curve_);
    if (ImGui::Button("Remove")) {
        next.occluders.erase(next.occluders.begin() + static_cast<std::ptrdiff_t>(index));
        session.change(next, "removal of an occluder");
    } else if (moved || changed) {
        session.change(next, moved ? "occluder's place" : "occluder's influence", "occluder " + name);
    }
}

void OccluderPanel::show_one(Session& session, size_t index) {
    const std::string name = session.shown().document.recipe->occluders[index].name;
    ImGui::PushID(static_cast<int>(index));
    bool on = !session.shown().document.off.contains(name);
    if (ImGui::Checkbox("##on", &on)) {
        session.switch_occluder(name, on);
    }
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("on: the edit under way and the next ones go around it");
    }
    ImGui::SameLine();
    const bool selected = session.occluders.selected() == name;
    if (selected != (opened_ == name)) { // selected in the scene, or no more
        ImGui::SetNextItemOpen(selected);
        opened_ = selected ? name : "";
    }
    const bool open = ImGui::TreeNodeEx(name.c_str(), selected ? ImGuiTreeNodeFlags_Selected : 0);
    if (ImGui::IsItemClicked()) {
        session.occluders.select(name);
        opened_ = name; // the click itself has opened or closed it
    }
    if (open) {
        show_settings(session, index);
        ImGui::TreePop();
    }
    ImGui::PopID();
}

void OccluderPanel::show(Session& session, PanelColumn& column) {
    if (!session.shown().mesh) {
        return;
    }
    column.begin("Occluders");
    ImGui::PushItemWidth(-110 * unit());
    add(session);
    const size_t count = session.shown().document.recipe->occluders.size();
    if (count > 0) {
        show_contacts(session);
    }
    for (size_t i = 0; i < count; ++i) {
        show_one(session, i);
    }
    if (count > 0) {
        show_hammer(session);
        if (dilation_controls(session.options.dilation, std::max(session.bounds().diagonal(), 1e-30))) {
            session.options_changed();
        }
    }
    ImGui::PopItemWidth();
    column.end();
}

} // namespace anvil

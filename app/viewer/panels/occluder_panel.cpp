#include "app/viewer/panels/occluder_panel.h"

#include "app/viewer/panels/controls.h"

#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <imgui.h>
#include <imgui_stdlib.h>

namespace anvil {

namespace {

bool drag_place(Vec3& place, double size) {
    glm::vec3 narrow(place);
    if (!ImGui::DragFloat3("place", glm::value_ptr(narrow), static_cast<float>(size) * 0.002F, 0, 0,
                           "%.4g")) {
        return false;
    }
    for (int axis = 0; axis < 3; ++axis) { // what was not dragged keeps its digits
        place[axis] = narrow[axis] == static_cast<float>(place[axis]) ? place[axis] : narrow[axis];
    }
    return true;
}

bool drag_number(const char* label, double& value, float speed, float least, float most) {
    auto narrow = static_cast<float>(value);
    const bool changed =
        ImGui::DragFloat(label, &narrow, speed, least, most, "%.4g", ImGuiSliderFlags_AlwaysClamp);
    value = changed ? narrow : value;
    return changed;
}

bool edit_transform(Transform& transform, double size) {
    bool changed = drag_place(transform.translate, size);
    changed = drag_number("degrees", transform.degrees, 0.5F, -360, 360) || changed;
    int axis = transform.axis == Vec3(1, 0, 0) ? 0 : transform.axis == Vec3(0, 0, 1) ? 2 : 1;
    if (ImGui::Combo("about", &axis, "x\0y\0z\0")) {
        transform.axis = Vec3(0);
        transform.axis[axis] = 1;
        changed = true;
    }
    return drag_number("scale", transform.scale, 0.005F, 1e-3F, 1e3F) || changed;
}

bool edit_influence(Influence& influence, double size) {
    constexpr std::array kinds{InfluenceKind::soft, InfluenceKind::hard, InfluenceKind::paper};
    if (influence.kind == InfluenceKind::curve) {
        ImGui::TextUnformatted("influence: its own curve");
        return false;
    }
    int kind = influence.kind == InfluenceKind::soft ? 0 : influence.kind == InfluenceKind::hard ? 1 : 2;
    bool changed = ImGui::Combo("influence", &kind, "soft\0hard\0as in the paper\0");
    if (changed) {
        influence = Influence{};
        influence.kind = kinds[static_cast<size_t>(kind)];
    }
    if (influence.kind == InfluenceKind::soft) {
        changed = drag_number("strength", influence.strength, 0.005F, 0, 1) || changed;
        double sigma = influence.sigma.value_or(0);
        if (drag_number("sigma (0: default)", sigma, static_cast<float>(size) * 5e-4F, 0,
                        static_cast<float>(size))) {
            influence.sigma = sigma > 0 ? std::optional(sigma) : std::nullopt;
            changed = true;
        }
    }
    return changed;
}

/// What the last edit met.
void show_contact(const SurfaceVersion& surface) {
    const std::optional<ContactReport>& contact = surface.report.contact;
    if (!contact) {
        return;
    }
    ImGui::Text("in contact: %zu vertices", contact->contact_vertices);
    ImGui::Text("triangles that dip in: %zu, at most %.4g", contact->penetrating_triangles,
                contact->deepest_dip);
    if (contact->started_inside > 0) {
        ImGui::Text("started inside: %zu vertices", contact->started_inside);
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
    }
}

void OccluderPanel::show(Session& session) {
    if (!session.shown().mesh) {
        return;
    }
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(window.x - side_width - 8, 0.55F * window.y), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints(ImVec2(side_width, 0), ImVec2(side_width, window.y));
    ImGui::Begin("Occluders", nullptr, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushItemWidth(-110);
    add(session);
    const double size = std::max(session.bounds().diagonal(), 1e-30);
    const Recipe& recipe = *session.shown().document.recipe;
    for (size_t i = 0; i < recipe.occluders.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::TreeNode(recipe.occluders[i].name.c_str())) {
            Recipe next = recipe;
            Occluder& occluder = next.occluders[i];
            const bool moved = edit_transform(occluder.transform, size);
            const bool changed = edit_influence(occluder.influence, size);
            if (ImGui::Button("Remove")) {
                next.occluders.erase(next.occluders.begin() + static_cast<std::ptrdiff_t>(i));
                session.change(next, "removal of an occluder");
            } else if (moved || changed) {
                session.change(next, moved ? "occluder's place" : "occluder's influence",
                               "occluder " + occluder.name);
            }
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
    show_contact(*session.shown().document.surface);
    ImGui::PopItemWidth();
    ImGui::End();
}

} // namespace anvil

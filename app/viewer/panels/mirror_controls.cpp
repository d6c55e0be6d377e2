#include "app/viewer/panels/mirror_controls.h"

#include "app/viewer/panels/controls.h"

#include <imgui.h>

namespace anvil {

bool mirror_controls(std::optional<Mirror>& mirror, const Box& scene) {
    int choice = mirror ? mirror->axis + 1 : 0;
    bool changed = false;
    if (ImGui::Combo("mirror", &choice, "off\0across x\0across y\0across z\0")) {
        const double origin = mirror ? mirror->origin : 0;
        mirror.reset();
        if (choice > 0) {
            mirror = Mirror{choice - 1, origin, std::nullopt};
        }
        changed = true;
    }
    if (!mirror) {
        return changed;
    }
    auto origin = static_cast<float>(mirror->origin);
    ImGui::PushItemWidth(110 * unit());
    if (ImGui::DragFloat("at", &origin, static_cast<float>(scene.diagonal()) * 1e-3F, 0, 0, "%.4g")) {
        mirror->origin = origin;
        changed = true;
    }
    ImGui::PopItemWidth();
    ImGui::SameLine();
    if (ImGui::Button("middle") && !scene.empty()) {
        mirror->origin = scene.centre()[mirror->axis];
        changed = true;
    }
    return changed;
}

} // namespace anvil

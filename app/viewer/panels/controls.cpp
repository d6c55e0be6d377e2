#include "app/viewer/panels/controls.h"

#include <imgui.h>

namespace anvil {

float unit() {
    return ImGui::GetFontSize() / 14;
}

float side_width() {
    return 290 * unit();
}

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

} // namespace anvil

#include "app/viewer/panels/panel_column.h"

#include "app/viewer/panels/controls.h"

#include <algorithm>
#include <imgui.h>

namespace anvil {

namespace {

constexpr float margin = 8;
constexpr float least_height = 120;
constexpr float least_view = 40;

} // namespace

PanelColumn::PanelColumn(Side side, float foot) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float space = margin * unit();
    left_ = side == Side::left ? space : window.x - side_width() - space;
    top_ = ImGui::GetFrameHeight() + space; // below the menus
    bottom_ = window.y - foot - space;
}

bool PanelColumn::has_room() {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    return window.x >= 2 * side_width() + (4 * margin + least_view) * unit() &&
           window.y >= 3 * least_height * unit();
}

void PanelColumn::begin(const char* title, float share, bool* open) {
    ImGui::SetNextWindowPos(ImVec2(left_, top_));
    const float room = std::max(share * (bottom_ - top_), least_height * unit());
    ImGui::SetNextWindowSizeConstraints(ImVec2(side_width(), 0), ImVec2(side_width(), room));
    ImGui::Begin(title, open, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize);
}

void PanelColumn::end() {
    top_ += ImGui::GetWindowHeight() + margin * unit();
    ImGui::End();
}

} // namespace anvil

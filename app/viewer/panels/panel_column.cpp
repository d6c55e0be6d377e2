#include "app/viewer/panels/panel_column.h"

#include "app/viewer/panels/controls.h"

#include <algorithm>
#include <imgui.h>

namespace anvil {

namespace {

constexpr float margin = 8;
constexpr float least_height = 120;

} // namespace

PanelColumn::PanelColumn(Side side) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    left_ = side == Side::left ? margin : window.x - side_width - margin;
    top_ = ImGui::GetFrameHeight() + margin;                                     // below the menus
    bottom_ = window.y - 2 * ImGui::GetTextLineHeightWithSpacing() - 2 * margin; // above the status bar
}

void PanelColumn::begin(const char* title, float share) {
    ImGui::SetNextWindowPos(ImVec2(left_, top_));
    const float room = std::max(share * (bottom_ - top_), least_height);
    ImGui::SetNextWindowSizeConstraints(ImVec2(side_width, 0), ImVec2(side_width, room));
    ImGui::Begin(title, nullptr, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize);
}

void PanelColumn::end() {
    top_ += ImGui::GetWindowHeight() + margin;
    ImGui::End();
}

} // namespace anvil

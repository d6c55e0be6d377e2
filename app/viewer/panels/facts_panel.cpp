#include "app/viewer/panels/facts_panel.h"

#include "app/viewer/panels/controls.h"
#include "engine/core/number_text.h"

#include <array>
#include <cmath>
#include <imgui.h>
#include <utility>

namespace anvil {

namespace {

const ImVec4 warning_colour(1.0F, 0.85F, 0.5F, 1);

void row(const char* title, const std::string& value) {
    ImGui::TextDisabled("%s", title);
    ImGui::SameLine(130 * unit());
    ImGui::TextUnformatted(value.c_str());
}

void show_mesh(Session& session) {
    const MeshHealth* health = session.health();
    if (health == nullptr) {
        ImGui::TextDisabled("being examined...");
        return;
    }
    row("triangles", std::to_string(health->triangles));
    row("parts", std::to_string(health->components));
    row("closed", health->closed ? "yes" : "no");
    row("volume", health->volume ? rounded_text(*health->volume) : "none: open");
    row("area", rounded_text(health->area));
    row("smallest angle", rounded_text(std::round(health->min_angle * 100) / 100) + " degrees");
    const std::vector<HealthAdvice> advice = advice_on(*health);
    if (advice.empty()) {
        ImGui::TextUnformatted("Nothing is wrong with it.");
    }
    for (const HealthAdvice& one : advice) {
        ImGui::PushStyleColor(ImGuiCol_Text, warning_colour);
        ImGui::TextWrapped("%s", one.finding.c_str());
        ImGui::PopStyleColor();
        ImGui::TextWrapped("   %s", one.mend.c_str());
    }
}

void show_times(const SurfaceVersion& surface) {
    const StageSeconds& s = surface.seconds;
    const std::array<std::pair<const char*, double>, 7> stages{{{"distances", s.distance},
                                                                {"system", s.solve},
                                                                {"refinement", s.refine},
                                                                {"baking", s.bake},
                                                                {"upload", s.upload},
                                                                {"deformation", s.deform},
                                                                {"download", s.download}}};
    for (const auto& [name, seconds] : stages) {
        row(name, rounded_text(std::round(seconds * 1e5) / 100) + " ms");
    }
    row("region, moved", std::to_string(surface.report.region) + ", " + std::to_string(surface.report.moved));
}

} // namespace

void show_facts(Session& session, PanelColumn& column, bool& open) {
    if (!open || !session.shown().mesh) {
        return;
    }
    column.begin("Mesh and times", 1, &open);
    show_mesh(session);
    ImGui::Separator();
    const SurfaceVersion& surface = *session.shown().document.surface;
    if (session.shown().document.recipe->edits.empty()) {
        ImGui::TextDisabled("no edit has been taken yet");
    } else {
        ImGui::TextUnformatted("The last edit took");
        show_times(surface);
    }
    ImGui::Separator();
    ImGui::TextWrapped("device: %s\ndriver: %s", session.shown().device.c_str(),
                       session.shown().driver.c_str());
    column.end();
}

} // namespace anvil

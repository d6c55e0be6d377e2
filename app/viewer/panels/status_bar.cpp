#include "app/viewer/panels/status_bar.h"

#include "app/viewer/panels/controls.h"
#include "app/viewer/panels/panel_column.h"
#include "engine/core/number_text.h"

#include <algorithm>
#include <imgui.h>

namespace anvil {

namespace {

const ImVec4 error_colour(1.0F, 0.55F, 0.45F, 1);
const ImVec4 warning_colour(1.0F, 0.85F, 0.5F, 1);

constexpr size_t longest_name = 40; ///< of a file, in characters

/// A name of at most so many characters: its middle is left out. UTF-8.
std::string shortened(const std::string& name) {
    std::vector<size_t> begins;
    for (size_t i = 0; i < name.size(); ++i) {
        if ((static_cast<unsigned char>(name[i]) & 0xC0U) != 0x80U) {
            begins.push_back(i);
        }
    }
    if (begins.size() <= longest_name) {
        return name;
    }
    constexpr size_t tail = longest_name / 2;
    return name.substr(0, begins[longest_name - tail - 3]) + "..." +
           name.substr(begins[begins.size() - tail]);
}

/// Of what is open, and of the last frames.
std::string facts_line(Session& session, const FrameTimes& times) {
    const Shown& shown = session.shown();
    std::string line = "nothing is open: File, Open, or drop a file here";
    if (shown.mesh) {
        const SurfaceVersion& surface = *shown.document.surface;
        const Vec3 extent = session.bounds().high - session.bounds().low;
        line = shortened(shown.mesh_file.filename().string()) + (shown.document.unsaved ? " (unsaved)" : "") +
               "   " + std::to_string(surface.mesh->vertex_count()) + " vertices, " +
               std::to_string(surface.mesh->polygon_count()) + " faces   " + rounded_text(extent.x) + " x " +
               rounded_text(extent.y) + " x " + rounded_text(extent.z);
        if (shown.look->selected_count > 0) {
            line += "   selected " + std::to_string(shown.look->selected_count);
        }
        if (shown.look->hidden_count > 0) {
            line += "   hidden " + std::to_string(shown.look->hidden_count);
        }
        if (const MeshHealth* health = session.health(); health != nullptr && !advice_on(*health).empty()) {
            line += "   " + std::to_string(advice_on(*health).size()) + " remarks (F2)";
        }
        if (shown.drag) {
            line += "   region " + std::to_string(shown.drag->region) + ", condition " +
                    rounded_text(shown.drag->condition) + ", step " +
                    rounded_text(std::round(shown.drag->milliseconds * 10) / 10) + " ms";
        }
    }
    return line + "   " + shown.device + "   " + rounded_text(std::round(times.milliseconds * 10) / 10) +
           " ms a frame";
}

float lines_height(const std::string& text) {
    const float width = ImGui::GetIO().DisplaySize.x - 2 * ImGui::GetStyle().WindowPadding.x;
    return ImGui::CalcTextSize(text.c_str(), nullptr, false, std::max(width, 1.0F)).y;
}

} // namespace

float status_height(Session& session, const FrameTimes& times) {
    const float most = ImGui::GetIO().DisplaySize.y / 3;
    const float text = lines_height(session.hint()) + lines_height(facts_line(session, times));
    return std::max(std::min(text, most), 2 * ImGui::GetTextLineHeight()) + ImGui::GetStyle().ItemSpacing.y +
           2 * ImGui::GetStyle().WindowPadding.y;
}

void show_status(Session& session, const FrameTimes& times) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float height = status_height(session, times);
    ImGui::SetNextWindowPos(ImVec2(0, window.y - height));
    ImGui::SetNextWindowSize(ImVec2(window.x, height));
    ImGui::Begin("status", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::TextWrapped("%s", session.hint().c_str());
    ImGui::TextWrapped("%s", facts_line(session, times).c_str());
    const WorkerState work = session.work();
    if (!work.job.empty() && work.seconds > 0.3) {
        ImGui::SameLine(std::max(window.x - 330 * unit(), 0.0F));
        const std::string text = work.job + (work.stage.empty() ? "" : ": " + work.stage);
        ImGui::ProgressBar(static_cast<float>(work.fraction), ImVec2(240 * unit(), 0), text.c_str());
        ImGui::SameLine();
        if (ImGui::SmallButton("Cancel")) {
            session.cancel_work();
        }
    }
    ImGui::End();
}

void show_notices(Session& session, float foot) {
    if (session.notices().empty()) {
        return;
    }
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float space = 8 * unit();
    // Between the columns, above the status bar.
    const float left = (PanelColumn::has_room() ? side_width() + space : 0) + space;
    const float width = window.x - 2 * left;
    const float bottom = window.y - foot - space;
    ImGui::SetNextWindowPos(ImVec2(left, bottom), ImGuiCond_Always, ImVec2(0, 1));
    ImGui::SetNextWindowSizeConstraints(ImVec2(std::min(300 * unit(), width), 0), ImVec2(width, bottom / 2));
    bool open = true;
    ImGui::Begin("Messages", &open,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushTextWrapPos(width - 2 * space);
    for (const Notice& notice : session.notices()) {
        ImGui::PushStyleColor(ImGuiCol_Text, notice.is_error ? error_colour : warning_colour);
        ImGui::TextUnformatted(notice.text.c_str());
        ImGui::PopStyleColor();
    }
    ImGui::PopTextWrapPos();
    ImGui::End();
    if (!open) {
        session.dismiss_notices();
    }
}

} // namespace anvil

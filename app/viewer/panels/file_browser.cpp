#include "app/viewer/panels/file_browser.h"

#include "app/viewer/panels/controls.h"

#include <algorithm>
#include <imgui.h>
#include <imgui_stdlib.h>

namespace anvil {

namespace fs = std::filesystem;

namespace {

constexpr float list_height = 300; ///< where the window is high enough
constexpr float beside_list = 190; ///< what else a dialog shows
constexpr float least_list = 50;

bool pressed(ImGuiKey_ key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
}

} // namespace

void FileBrowser::begin(const fs::path& file, std::vector<std::string> extensions, bool writes) {
    extensions_ = std::move(extensions);
    writes_ = writes;
    go_to(folder_to_begin_in(file));
    std::error_code failed;
    name_ = file.empty() || fs::is_directory(file, failed) ? std::string() : file.filename().string();
}

void FileBrowser::go_to(const fs::path& folder) {
    listing_ = list_folder(folder, extensions_);
    chosen_ = listing_.entries.size();
    wants_focus_ = true;
    ++name_generation_;
    if (!writes_) {
        name_.clear();
    }
}

void FileBrowser::choose(size_t entry) {
    chosen_ = entry;
    scrolls_ = true;
    if (!(writes_ && listing_.entries[entry].is_folder)) { // which keeps the name of what is to be written
        name_ = listing_.entries[entry].name;
    }
    wants_focus_ = true;
    ++name_generation_;
}

void FileBrowser::show_folders_above() {
    fs::path at;
    std::optional<fs::path> gone_to;
    int id = 0;
    for (const fs::path& part : listing_.folder) {
        at /= part;
        if (part.empty()) {
            continue;
        }
        if (id > 0) {
            ImGui::SameLine(0, 3);
        }
        ImGui::PushID(id++);
        if (ImGui::SmallButton(part.string().c_str())) {
            gone_to = at;
        }
        ImGui::PopID();
    }
    if (gone_to) {
        go_to(*gone_to);
    }
}

/// Whether it was double-clicked.
bool FileBrowser::show_entry(size_t index) {
    const FolderEntry& entry = listing_.entries[index];
    bool taken = false;
    ImGui::TableNextColumn();
    ImGui::PushID(static_cast<int>(index));
    const std::string label = entry.name + (entry.is_folder ? "/" : "");
    if (ImGui::Selectable(label.c_str(), index == chosen_,
                          ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_SpanAllColumns)) {
        choose(index);
        scrolls_ = false;
        taken = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    }
    if (index == chosen_ && scrolls_) {
        ImGui::SetScrollHereY();
        scrolls_ = false;
    }
    ImGui::TableNextColumn();
    if (!entry.is_folder) {
        ImGui::TextDisabled("%s", file_size_text(entry.bytes).c_str());
    }
    ImGui::PopID();
    return taken;
}

/// Whether an entry was double-clicked.
bool FileBrowser::show_entries() {
    bool taken = false;
    const float height = ImGui::GetIO().DisplaySize.y - beside_list * unit();
    ImGui::BeginChild("entries", ImVec2(0, std::clamp(height, least_list * unit(), list_height * unit())),
                      true);
    if (ImGui::BeginTable("entries", 2)) {
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("size", ImGuiTableColumnFlags_WidthFixed, 60 * unit());
        for (size_t i = 0; i < listing_.entries.size(); ++i) {
            taken = show_entry(i) || taken;
        }
        ImGui::EndTable();
    }
    if (!listing_.complaint.empty()) {
        ImGui::TextWrapped("%s", listing_.complaint.c_str());
    } else if (listing_.entries.empty()) {
        ImGui::TextDisabled("nothing of this kind here");
    }
    ImGui::EndChild();
    return taken;
}

/// Whether Enter was pressed.
bool FileBrowser::show_name() {
    ImGui::PushID(name_generation_);
    if (wants_focus_) {
        ImGui::SetKeyboardFocusHere();
        wants_focus_ = false;
    }
    ImGui::SetNextItemWidth(-60 * unit());
    const bool entered = ImGui::InputText("name", &name_, ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::PopID();
    return entered;
}

void FileBrowser::follow_keys() {
    const size_t count = listing_.entries.size();
    const bool up = pressed(ImGuiKey_UpArrow);
    if ((up && ImGui::GetIO().KeyAlt) ||
        (name_.empty() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Backspace), false))) {
        go_to(listing_.folder.parent_path());
    } else if (count > 0 && up) {
        choose(chosen_ >= count || chosen_ == 0 ? count - 1 : chosen_ - 1);
    } else if (count > 0 && pressed(ImGuiKey_DownArrow)) {
        choose(chosen_ + 1 >= count ? 0 : chosen_ + 1);
    }
}

std::optional<fs::path> FileBrowser::show() {
    follow_keys();
    show_folders_above();
    const bool double_clicked = show_entries();
    const bool entered = show_name();
    if (double_clicked && chosen_ < listing_.entries.size() && listing_.entries[chosen_].is_folder) {
        go_to(listing_.folder / listing_.entries[chosen_].name);
        return std::nullopt;
    }
    return double_clicked || entered ? take() : std::nullopt;
}

std::optional<fs::path> FileBrowser::take() {
    if (name_.empty()) {
        return std::nullopt;
    }
    fs::path file = listing_.folder / name_; // an absolute name stands for itself
    std::error_code failed;
    if (fs::is_directory(file, failed)) {
        name_.clear();
        go_to(file);
        return std::nullopt;
    }
    if (writes_ && file.extension().empty() && !extensions_.empty()) {
        file += extensions_.front();
    }
    return file;
}

} // namespace anvil

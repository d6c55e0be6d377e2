#include "app/viewer/panels/curve_files.h"

#include "engine/core/error.h"
#include "engine/core/user_folder.h"
#include "engine/edit/shape_file.h"

#include <algorithm>
#include <imgui.h>
#include <imgui_stdlib.h>

namespace anvil {

namespace fs = std::filesystem;

std::optional<fs::path> curve_folder() {
    const auto folder = user_data_folder();
    return folder ? std::optional(*folder / "curves") : std::nullopt;
}

std::vector<std::string> curves_in(const std::optional<fs::path>& folder) {
    std::vector<std::string> names;
    std::error_code error;
    if (!folder) {
        return names;
    }
    for (fs::directory_iterator entry(*folder, error), end; !error && entry != end; entry.increment(error)) {
        if (entry->path().extension() == ".json") {
            names.push_back(entry->path().stem().string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

fs::path curve_file(const std::string& name, const std::optional<fs::path>& folder) {
    const fs::path given = name;
    if (given.has_parent_path() || given.extension() == ".json") {
        return fs::absolute(given);
    }
    if (name.empty() || !folder) {
        throw InputError("name the curve, or the file (.json) that it is in");
    }
    return *folder / (name + ".json");
}

void save_curve(const ShapeChoice& shape, const fs::path& file) {
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    if (error) {
        throw WriteError(file.parent_path().string() + ": cannot be made: " + error.message());
    }
    write_shape_file(file, shape);
}

bool CurveFiles::load(ShapeChoice& shape, const std::string& name) {
    try {
        shape = read_shape_file(curve_file(name, curve_folder()));
        said_.clear();
        return true;
    } catch (const std::exception& error) {
        said_ = error.what();
        return false;
    }
}

bool CurveFiles::show(ShapeChoice& shape) {
    bool changed = false;
    if (ImGui::Button("My curves...")) {
        ImGui::OpenPopup("curves");
    }
    if (ImGui::BeginPopup("curves")) {
        for (const std::string& name : curves_in(curve_folder())) {
            if (ImGui::Selectable(name.c_str())) {
                changed = load(shape, name);
                name_ = changed ? name : name_;
            }
        }
        ImGui::Separator();
        ImGui::SetNextItemWidth(220);
        ImGui::InputTextWithHint("##name", "name, or a file (.json)", &name_);
        if (ImGui::Button("Load")) {
            changed = load(shape, name_);
        }
        ImGui::SameLine();
        if (ImGui::Button("Save")) {
            try {
                const fs::path file = curve_file(name_, curve_folder());
                save_curve(shape, file);
                said_ = "saved " + file.string();
            } catch (const std::exception& error) {
                said_ = error.what();
            }
        }
        if (!said_.empty()) {
            ImGui::PushTextWrapPos(320);
            ImGui::TextUnformatted(said_.c_str());
            ImGui::PopTextWrapPos();
        }
        ImGui::EndPopup();
    }
    return changed;
}

} // namespace anvil

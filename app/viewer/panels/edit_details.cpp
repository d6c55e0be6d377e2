#include "app/viewer/panels/edit_details.h"

#include "app/viewer/panels/controls.h"
#include "app/viewer/panels/mirror_controls.h"
#include "app/viewer/panels/occluder_controls.h"
#include "app/viewer/panels/refine_controls.h"

#include <algorithm>
#include <imgui.h>

namespace anvil {

namespace {

constexpr double default_radius = 0.25; ///< of the scene, where a slider takes the default's place

/// Where the handle is to go; a path is scaled as a whole, so that it keeps its form.
bool target_controls(Handle& handle, double size) {
    if (handle.by) {
        return place_control("by", *handle.by, size);
    }
    if (handle.degrees) {
        return number_control("degrees", *handle.degrees, 0.5F, -3600, 3600);
    }
    if (handle.to) {
        return place_control("to", *handle.to, size);
    }
    ImGui::Text("a path of %zu places", handle.path.size());
    if (!ImGui::Button("straight")) {
        return false;
    }
    handle.by = handle.path.back();
    handle.path.clear();
    return true;
}

bool handle_controls(Edit& edit, double size) {
    bool changed = false;
    for (size_t i = 0; i < edit.handles.size(); ++i) {
        Handle& handle = edit.handles[i];
        ImGui::PushID(static_cast<int>(i));
        ImGui::Text("handle %zu", i + 1);
        changed = target_controls(handle, size) || changed;
        if (handle.radius) {
            changed = length_slider("its radius", *handle.radius, size) || changed;
        }
        ImGui::PopID();
    }
    if (edit.kind == EditKind::rotate) {
        changed = place_control("about", edit.axis.origin, size) || changed;
        Vec3 direction = edit.axis.direction;
        if (place_control("axis", direction, 5) && glm::length(direction) > 0) {
            edit.axis.direction = direction;
            changed = true;
        }
    }
    return changed;
}

bool distance_controls(Edit& edit) {
    int metric = edit.metric == Metric::euclidean ? 1 : 0;
    bool changed = ImGui::Combo("distance", &metric, "along the surface\0straight\0");
    edit.metric = metric == 1 ? Metric::euclidean : Metric::geodesic;
    int method = static_cast<int>(edit.method);
    if (edit.metric == Metric::geodesic && ImGui::Combo("method", &method, "auto\0approximate\0exact\0")) {
        edit.method = static_cast<DistanceMethod>(method);
        changed = true;
    }
    auto rounds = static_cast<int>(edit.smooth_surface);
    if (ImGui::InputInt("smoothed by", &rounds)) {
        edit.smooth_surface = static_cast<uint32_t>(std::clamp(rounds, 0, 1000));
        changed = true;
    }
    return ImGui::Checkbox("least squares", &edit.least_squares) || changed;
}

} // namespace

bool EditDetails::show_occluders(Edit& edit, double size) {
    bool changed = false;
    if (!edit.occluders || edit.occluders->empty() || !ImGui::TreeNode("occluders")) {
        return false;
    }
    std::optional<size_t> gone;
    for (size_t i = 0; i < edit.occluders->size(); ++i) {
        OccluderUse& use = (*edit.occluders)[i];
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::TreeNode(use.name.c_str())) {
            if (use.transform && use.motion.empty()) {
                changed = transform_controls(*use.transform, size) || changed;
            } else if (!use.motion.empty()) {
                ImGui::Text("a hammer: %zu poses", use.motion.size());
            }
            if (use.influence) {
                changed = influence_controls(*use.influence, size, influence_) || changed;
            }
            if (ImGui::Button("Leave out of this edit")) {
                gone = i;
            }
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
    if (gone) {
        edit.occluders->erase(edit.occluders->begin() + static_cast<std::ptrdiff_t>(*gone));
        changed = true;
    }
    ImGui::TreePop();
    return changed;
}

bool EditDetails::show(Edit& edit, const Box& scene) {
    const double size = std::max(scene.diagonal(), 1e-30);
    double radius = edit.radius.value_or(default_radius * size);
    bool changed = false;
    if (length_slider("radius", radius, size)) {
        edit.radius = radius;
        changed = true;
    }
    auto amount = static_cast<float>(edit.amount);
    if (ImGui::SliderFloat("amount", &amount, 0, 1)) {
        edit.amount = amount;
        changed = true;
    }
    if (!edit.handles.empty()) {
        changed = shape_combo("shape", edit.shape) || changed;
        if (ImGui::TreeNode("curve")) {
            changed = curve_.show(edit.shape) || changed;
            ImGui::TreePop();
        }
    }
    if (!edit.handles.empty() && ImGui::TreeNode("handles")) {
        changed = handle_controls(edit, size) || changed;
        ImGui::TreePop();
    }
    if (ImGui::TreeNode("distances")) {
        changed = distance_controls(edit) || changed;
        ImGui::TreePop();
    }
    changed = show_occluders(edit, size) || changed;
    if (ImGui::TreeNode("swelling, fineness, mirror")) {
        changed = dilation_controls(edit.dilation, size) || changed;
        changed = refine_controls(edit.refine, size) || changed;
        changed = mirror_controls(edit.mirror, scene) || changed;
        ImGui::TreePop();
    }
    return changed;
}

} // namespace anvil

#include "app/viewer/panels/refine_controls.h"

#include "app/viewer/panels/controls.h"
#include "app/viewer/panels/occluder_controls.h"

#include <algorithm>
#include <imgui.h>

namespace anvil {

namespace {

constexpr double default_space = 1e-3; ///< of the scene

bool limit_controls(Refine& refine, double size) {
    bool changed = number_control("least edge", refine.min_edge, static_cast<float>(1e-4 * size), 0,
                                  static_cast<float>(size));
    auto most = static_cast<int>(std::min<uint32_t>(refine.max_vertices.value_or(0), 2'000'000'000));
    if (ImGui::InputInt("most vertices (0: auto)", &most, 10000, 100000)) {
        refine.max_vertices = most > 0 ? std::optional(static_cast<uint32_t>(most)) : std::nullopt;
        changed = true;
    }
    changed = ImGui::Checkbox("flip", &refine.flip) || changed;
    ImGui::SameLine();
    return ImGui::Checkbox("relax", &refine.relax) || changed;
}

} // namespace

bool refine_controls(std::optional<Refine>& refine, double size) {
    int choice = refine ? static_cast<int>(refine->criterion) + 1 : 0;
    bool changed = ImGui::Combo("refine", &choice, "off\0by shape\0in space\0both\0");
    if (changed && choice == 0) {
        refine.reset();
    } else if (changed) {
        refine = refine.value_or(Refine{});
        refine->criterion = static_cast<RefineCriterion>(choice - 1);
        const bool in_space = refine->criterion != RefineCriterion::shape;
        refine->space_tolerance = !in_space                     ? 0
                                  : refine->space_tolerance > 0 ? refine->space_tolerance
                                                                : default_space * size;
    }
    if (!refine) {
        return changed;
    }
    if (refine->criterion != RefineCriterion::space) {
        changed = length_slider("tolerance", refine->shape_tolerance, 0.1) || changed;
    }
    if (refine->criterion != RefineCriterion::shape) {
        changed = length_slider("in space", refine->space_tolerance, 0.05 * size) || changed;
    }
    if (ImGui::TreeNode("limits and angles")) {
        changed = limit_controls(*refine, size) || changed;
        ImGui::TreePop();
    }
    return changed;
}

void show_refinement(const RefineSummary& summary, size_t vertices) {
    ImGui::Text("adds %zu vertices (to %zu)", summary.added, vertices);
    ImGui::Text("error %.3g, stopped by %s", summary.max_error, summary.stopped_by.c_str());
}

} // namespace anvil

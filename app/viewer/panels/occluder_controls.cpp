#include "app/viewer/panels/occluder_controls.h"

#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <imgui.h>

namespace anvil {

bool number_control(const char* label, double& value, float speed, float least, float most) {
    auto narrow = static_cast<float>(value);
    const bool changed =
        ImGui::DragFloat(label, &narrow, speed, least, most, "%.4g", ImGuiSliderFlags_AlwaysClamp);
    value = changed ? narrow : value;
    return changed;
}

bool place_control(const char* label, Vec3& place, double size) {
    glm::vec3 narrow(place);
    if (!ImGui::DragFloat3(label, glm::value_ptr(narrow), static_cast<float>(size) * 0.002F, 0, 0, "%.4g")) {
        return false;
    }
    for (int axis = 0; axis < 3; ++axis) { // what was not dragged keeps its digits
        place[axis] = narrow[axis] == static_cast<float>(place[axis]) ? place[axis] : narrow[axis];
    }
    return true;
}

bool transform_controls(Transform& transform, double size) {
    bool changed = place_control("place", transform.translate, size);
    changed = number_control("degrees", transform.degrees, 0.5F, -720, 720) || changed;
    Vec3 axis = transform.axis;
    if (place_control("about", axis, 5) && glm::length(axis) > 0) {
        transform.axis = axis;
        changed = true;
    }
    return number_control("scale", transform.scale, 0.005F, 1e-3F, 1e3F) || changed;
}

namespace {

bool soft_controls(Influence& influence, double size) {
    bool changed = number_control("strength", influence.strength, 0.005F, 0, 1);
    double sigma = influence.sigma.value_or(0);
    if (number_control("sigma (0: auto)", sigma, static_cast<float>(size) * 5e-4F, 0,
                       static_cast<float>(size))) {
        influence.sigma = sigma > 0 ? std::optional(sigma) : std::nullopt;
        changed = true;
    }
    return changed;
}

bool curve_controls(Influence& influence, double size, CurveEditor& curve) {
    const auto least = static_cast<float>(1e-4 * size);
    bool changed = number_control("width", influence.width, static_cast<float>(size) * 1e-3F, least,
                                  static_cast<float>(size));
    ShapeChoice shape{"", influence.knots};
    if (curve.show(shape)) {
        influence.knots = with_own_knots(shape).knots;
        changed = true;
    }
    return changed;
}

} // namespace

bool influence_controls(Influence& influence, double size, CurveEditor& curve) {
    constexpr std::array kinds{InfluenceKind::soft, InfluenceKind::hard, InfluenceKind::curve,
                               InfluenceKind::paper};
    int kind = 0;
    for (size_t i = 0; i < kinds.size(); ++i) {
        kind = kinds[i] == influence.kind ? static_cast<int>(i) : kind;
    }
    bool changed = ImGui::Combo("influence", &kind, "soft\0hard\0own curve\0as in the paper\0");
    if (changed) {
        influence = Influence{};
        influence.kind = kinds[static_cast<size_t>(kind)];
        if (influence.kind == InfluenceKind::curve) {
            influence.knots = preset_knots("smooth");
            influence.width = 0.05 * size;
        }
    }
    if (influence.kind == InfluenceKind::soft) {
        changed = soft_controls(influence, size) || changed;
    } else if (influence.kind == InfluenceKind::curve) {
        changed = curve_controls(influence, size, curve) || changed;
    }
    return changed;
}

bool dilation_controls(std::optional<Dilation>& dilation, double size) {
    int form = !dilation ? 0 : dilation->solve ? 3 : dilation->form == DilationForm::volume ? 2 : 1;
    bool changed = ImGui::Combo("swelling", &form, "none\0by depth\0by volume\0volume is kept\0");
    if (changed) {
        const auto width = dilation ? dilation->width : std::nullopt;
        dilation.reset();
        if (form > 0) {
            dilation = Dilation{form == 1 ? DilationForm::depth : DilationForm::volume, 1, form == 3, width};
        }
    }
    if (!dilation) {
        return changed;
    }
    if (!dilation->solve) {
        changed = number_control("amount", dilation->amount, 0.01F, 0, 100) || changed;
    }
    double width = dilation->width.value_or(0);
    if (number_control("width (0: auto)", width, static_cast<float>(size) * 1e-3F, 0,
                       static_cast<float>(size))) {
        dilation->width = width > 0 ? std::optional(width) : std::nullopt;
        changed = true;
    }
    return changed;
}

void show_live_contact(const LiveContact& contact) {
    ImGui::Text("touching: %zu vertices, %zu triangles", contact.vertices, contact.triangles);
    if (contact.vertex && contact.vertex->depth > 0) {
        ImGui::Text("deepest vertex: %.3g inside", contact.vertex->depth);
    } else if (contact.vertex) {
        ImGui::Text("deepest vertex: %.3g outside", -contact.vertex->depth);
    }
    if (contact.triangle) {
        ImGui::Text("deepest triangle: %.3g inside", contact.triangle->depth);
    }
}

void show_contact(const EditReport& report) {
    if (!report.contact) {
        return;
    }
    const ContactReport& contact = *report.contact;
    ImGui::Text("touching: %zu vertices", contact.contact_vertices);
    ImGui::Text("triangles that dip in: %zu, at most %.3g", contact.penetrating_triangles,
                contact.deepest_dip);
    if (contact.penetrating_vertices > 0) {
        ImGui::Text("vertices inside: %zu, at most %.3g", contact.penetrating_vertices,
                    contact.max_penetration);
    }
    if (contact.started_inside > 0) {
        ImGui::Text("started inside: %zu vertices", contact.started_inside);
    }
}

void show_volume(double before, double after) {
    const double percent = before != 0 ? 100 * (after / before - 1) : 0;
    ImGui::Text("volume: %.5g to %.5g (%+.3f %%)", std::abs(before), std::abs(after), percent);
}

} // namespace anvil

#include "app/viewer/panels/curve_editor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <imgui.h>

namespace anvil {

namespace {

constexpr float height = 150;
constexpr float grab_pixels = 8;
constexpr double slope_reach = 0.12; ///< of t: how long the handles of slopes are
constexpr double most_slope = 50;
constexpr ImU32 ground = IM_COL32(25, 26, 30, 255);
constexpr ImU32 line_colour = IM_COL32(70, 72, 80, 255);
constexpr ImU32 curve_colour = IM_COL32(255, 176, 32, 255);
constexpr ImU32 knot_colour = IM_COL32(255, 255, 255, 255);
constexpr ImU32 slope_colour = IM_COL32(64, 150, 255, 255);

/// Places on the canvas: t from left to right, values from `least` to `most` upwards.
struct Canvas {
    ImVec2 low;
    ImVec2 size;
    double least;
    double most;

    ImVec2 place(double t, double value) const {
        return {low.x + static_cast<float>(t) * size.x,
                low.y + size.y * static_cast<float>((most - value) / (most - least))};
    }
    double t_at(float x) const { return (x - low.x) / size.x; }
    double value_at(float y) const { return most - (y - low.y) / size.y * (most - least); }
};

float apart(const ImVec2& a, const ImVec2& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

double slope_of(const std::optional<double>& given, const ShapeFunction& phi, double t, double side) {
    constexpr double step = 1e-5;
    return given.value_or((phi(t + side * step) - phi(t)) / (side * step));
}

/// All of the curve, and room to drag it further.
Canvas canvas_for(const ShapeFunction& phi) {
    Canvas canvas{ImGui::GetCursorScreenPos(), ImVec2(ImGui::GetContentRegionAvail().x, height), -0.3, 1.15};
    constexpr int steps = 200;
    for (int i = 0; i <= steps; ++i) {
        const double value = 1.1 * phi(static_cast<double>(i) / steps);
        canvas.least = std::min(canvas.least, value);
        canvas.most = std::max(canvas.most, value);
    }
    return canvas;
}

void draw_curve(const Canvas& canvas, const ShapeFunction& phi) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(canvas.low, ImVec2(canvas.low.x + canvas.size.x, canvas.low.y + canvas.size.y), ground,
                       3);
    for (const double value : {0.0, 1.0}) {
        list.AddLine(canvas.place(0, value), canvas.place(1, value), line_colour);
    }
    constexpr size_t steps = 120;
    std::array<ImVec2, steps + 1> points;
    for (size_t i = 0; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        points[i] = canvas.place(t, phi(t));
    }
    list.AddPolyline(points.data(), static_cast<int>(points.size()), curve_colour, 0, 2);
}

} // namespace

bool CurveEditor::show(ShapeChoice& shape) {
    ShapeChoice own = with_own_knots(shape);
    const ShapeFunction phi = make_shape_function(own);
    const Canvas canvas = canvas_for(phi);
    ImGui::InvisibleButton("curve", canvas.size);
    draw_curve(canvas, phi);
    selected_ = std::min(selected_, own.knots.size() - 1);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const Knot& chosen = own.knots[selected_];
    const std::array<double, 2> slopes{slope_of(chosen.left, phi, chosen.t, -1),
                                       slope_of(chosen.right, phi, chosen.t, 1)};
    const std::array<ImVec2, 2> ends{
        canvas.place(chosen.t - slope_reach, chosen.value - slope_reach * slopes[0]),
        canvas.place(chosen.t + slope_reach, chosen.value + slope_reach * slopes[1])};
    const std::array<bool, 2> has{selected_ > 0, selected_ + 1 < own.knots.size()};
    for (size_t side = 0; side < 2; ++side) {
        if (has[side]) {
            list.AddLine(canvas.place(chosen.t, chosen.value), ends[side], slope_colour);
            list.AddCircleFilled(ends[side], 3.5F, slope_colour);
        }
    }
    for (size_t i = 0; i < own.knots.size(); ++i) {
        list.AddCircleFilled(canvas.place(own.knots[i].t, own.knots[i].value), i == selected_ ? 5.0F : 4.0F,
                             knot_colour);
    }
    const auto near = [&]() -> std::optional<size_t> {
        for (size_t i = 0; i < own.knots.size(); ++i) {
            if (apart(mouse, canvas.place(own.knots[i].t, own.knots[i].value)) < grab_pixels) {
                return i;
            }
        }
        return std::nullopt;
    };
    bool changed = false;
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0) && !near()) {
        selected_ = add_knot(own, canvas.t_at(mouse.x));
        changed = true;
    } else if (ImGui::IsItemClicked(0)) {
        const auto found = near();
        dragged_ = found                                           ? Part::knot
                   : has[0] && apart(mouse, ends[0]) < grab_pixels ? Part::left
                   : has[1] && apart(mouse, ends[1]) < grab_pixels ? Part::right
                                                                   : Part::none;
        selected_ = found.value_or(selected_);
    } else if (ImGui::IsItemHovered() && ImGui::IsMouseClicked(1)) {
        const auto found = near();
        changed = found && remove_knot(own, *found);
    }
    if (!ImGui::IsMouseDown(0)) {
        dragged_ = Part::none;
    } else if (dragged_ != Part::none &&
               (ImGui::GetIO().MouseDelta.x != 0 || ImGui::GetIO().MouseDelta.y != 0)) {
        const double t = canvas.t_at(mouse.x);
        const double value = canvas.value_at(mouse.y);
        Knot& knot = own.knots[selected_];
        if (dragged_ == Part::knot) {
            move_knot(own, selected_, t, value);
        } else {
            const double run =
                dragged_ == Part::left ? std::min(t - knot.t, -1e-3) : std::max(t - knot.t, 1e-3);
            const double slope = std::clamp((value - knot.value) / run, -most_slope, most_slope);
            const bool kink = ImGui::GetIO().KeyAlt || (knot.left && knot.right && *knot.left != *knot.right);
            if (dragged_ == Part::left || !kink) {
                knot.left = slope;
            }
            if (dragged_ == Part::right || !kink) {
                knot.right = slope;
            }
        }
        changed = true;
    }
    if (changed) {
        shape = own;
    }
    return changed;
}

} // namespace anvil

#include "app/viewer/panels/curve_editor.h"

#include "app/viewer/panels/controls.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>

namespace anvil {

namespace {

constexpr float height = 150; ///< on a display of 96 dots an inch
constexpr float grab_pixels = 8;
constexpr double slope_reach = 0.12; ///< of t: how long the handles of slopes are
constexpr double most_slope = 50;
constexpr ImU32 ground = IM_COL32(25, 26, 30, 255);
constexpr ImU32 line_colour = IM_COL32(70, 72, 80, 255);
constexpr ImU32 curve_colour = IM_COL32(255, 176, 32, 255);
constexpr ImU32 knot_colour = IM_COL32(255, 255, 255, 255);
constexpr ImU32 slope_colour = IM_COL32(64, 150, 255, 255);

float apart(const ImVec2& a, const ImVec2& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

double slope_of(const std::optional<double>& given, const ShapeFunction& phi, double t, double side) {
    constexpr double step = 1e-5;
    return given.value_or((phi(t + side * step) - phi(t)) / (side * step));
}

} // namespace

/// Places on the canvas: t from left to right, values from `least` to `most` upwards.
struct CurveEditor::Canvas {
    ImVec2 low;
    ImVec2 size;
    double least;
    double most;

    /// All of the curve, and room to drag it further.
    explicit Canvas(const ShapeFunction& phi)
        : low(ImGui::GetCursorScreenPos()), size(ImGui::GetContentRegionAvail().x, height * unit()),
          least(-0.3), most(1.15) {
        constexpr int steps = 200;
        for (int i = 0; i <= steps; ++i) {
            const double value = 1.1 * phi(static_cast<double>(i) / steps);
            least = std::min(least, value);
            most = std::max(most, value);
        }
    }

    ImVec2 place(double t, double value) const {
        return {low.x + static_cast<float>(t) * size.x,
                low.y + size.y * static_cast<float>((most - value) / (most - least))};
    }
    ImVec2 place(const Knot& knot) const { return place(knot.t, knot.value); }
    double t_at(float x) const { return (x - low.x) / size.x; }
    double value_at(float y) const { return most - (y - low.y) / size.y * (most - least); }
};

/// The handles of the selected knot's slopes, left and right.
struct CurveEditor::Slopes {
    std::array<ImVec2, 2> ends;
    std::array<bool, 2> has;

    Slopes(const Canvas& canvas, const ShapeChoice& shape, const ShapeFunction& phi, size_t selected)
        : has{selected > 0, selected + 1 < shape.knots.size()} {
        const Knot& knot = shape.knots[selected];
        const double left = slope_of(knot.left, phi, knot.t, -1);
        const double right = slope_of(knot.right, phi, knot.t, 1);
        ends[0] = canvas.place(knot.t - slope_reach, knot.value - slope_reach * left);
        ends[1] = canvas.place(knot.t + slope_reach, knot.value + slope_reach * right);
    }

    bool under_mouse(size_t side) const {
        return has[side] && apart(ImGui::GetIO().MousePos, ends[side]) < grab_pixels * unit();
    }
};

void CurveEditor::draw(const Canvas& canvas, const ShapeChoice& shape, const Slopes& slopes) const {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(canvas.low, ImVec2(canvas.low.x + canvas.size.x, canvas.low.y + canvas.size.y), ground,
                       3);
    for (const double value : {0.0, 1.0}) {
        list.AddLine(canvas.place(0, value), canvas.place(1, value), line_colour);
    }
    const ShapeFunction phi = make_shape_function(shape);
    constexpr size_t steps = 120;
    std::array<ImVec2, steps + 1> points;
    for (size_t i = 0; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        points[i] = canvas.place(t, phi(t));
    }
    list.AddPolyline(points.data(), static_cast<int>(points.size()), curve_colour, 0, 2);
    for (size_t side = 0; side < 2; ++side) {
        if (slopes.has[side]) {
            list.AddLine(canvas.place(shape.knots[selected_]), slopes.ends[side], slope_colour);
            list.AddCircleFilled(slopes.ends[side], 3.5F * unit(), slope_colour);
        }
    }
    for (size_t i = 0; i < shape.knots.size(); ++i) {
        list.AddCircleFilled(canvas.place(shape.knots[i]), (i == selected_ ? 5.0F : 4.0F) * unit(),
                             knot_colour);
    }
}

std::optional<size_t> CurveEditor::knot_under_mouse(const Canvas& canvas, const ShapeChoice& shape) const {
    for (size_t i = 0; i < shape.knots.size(); ++i) {
        if (apart(ImGui::GetIO().MousePos, canvas.place(shape.knots[i])) < grab_pixels * unit()) {
            return i;
        }
    }
    return std::nullopt;
}

/// Buttons that went down in this frame.
bool CurveEditor::click(const Canvas& canvas, const Slopes& slopes, ShapeChoice& shape) {
    if (!ImGui::IsItemHovered()) {
        return false;
    }
    const auto found = knot_under_mouse(canvas, shape);
    if (ImGui::IsMouseDoubleClicked(0) && !found) {
        selected_ = add_knot(shape, canvas.t_at(ImGui::GetIO().MousePos.x));
        return true;
    }
    if (ImGui::IsMouseClicked(0)) {
        dragged_ = found                   ? Part::knot
                   : slopes.under_mouse(0) ? Part::left
                   : slopes.under_mouse(1) ? Part::right
                                           : Part::none;
        selected_ = found.value_or(selected_);
    }
    return ImGui::IsMouseClicked(1) && found && remove_knot(shape, *found);
}

/// To where the mouse is.
bool CurveEditor::drag(const Canvas& canvas, ShapeChoice& shape) const {
    const ImGuiIO& io = ImGui::GetIO();
    if (dragged_ == Part::none || (io.MouseDelta.x == 0 && io.MouseDelta.y == 0)) {
        return false;
    }
    const double t = canvas.t_at(io.MousePos.x);
    const double value = canvas.value_at(io.MousePos.y);
    if (dragged_ == Part::knot) {
        move_knot(shape, selected_, t, value, most_value_);
        return true;
    }
    Knot& knot = shape.knots[selected_];
    const bool left = dragged_ == Part::left;
    const double run = left ? std::min(t - knot.t, -1e-3) : std::max(t - knot.t, 1e-3);
    turn_slope(knot, left, std::clamp((value - knot.value) / run, -most_slope, most_slope), io.KeyAlt);
    return true;
}

bool CurveEditor::show(ShapeChoice& shape) {
    ShapeChoice own = with_own_knots(shape);
    const ShapeFunction phi = make_shape_function(own);
    const Canvas canvas(phi);
    ImGui::InvisibleButton("curve", canvas.size);
    selected_ = std::min(selected_, own.knots.size() - 1);
    const Slopes slopes(canvas, own, phi, selected_);
    draw(canvas, own, slopes);
    bool changed = click(canvas, slopes, own);
    if (!ImGui::IsMouseDown(0)) {
        dragged_ = Part::none;
    } else {
        changed = drag(canvas, own) || changed;
    }
    if (changed) {
        shape = own;
    }
    return files_.show(shape) || changed;
}

} // namespace anvil

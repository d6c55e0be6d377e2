#include "app/viewer/panels/selection_marks.h"

#include <imgui.h>

namespace anvil {

namespace {

constexpr ImU32 outline = IM_COL32(20, 20, 24, 230);
constexpr ImU32 selection_colour = IM_COL32(255, 240, 120, 255);
constexpr ImU32 pin_colour = IM_COL32(230, 90, 160, 255);
constexpr size_t most_pins = 400; ///< that are drawn, evenly among all

ImVec2 at(const Cursor& cursor) {
    return {static_cast<float>(cursor.x), static_cast<float>(cursor.y)};
}

void draw_outline(const std::vector<Cursor>& points, ImDrawList& list) {
    for (size_t i = 0; points.size() > 1 && i < points.size(); ++i) {
        const ImVec2 a = at(points[i]);
        const ImVec2 b = at(points[(i + 1) % points.size()]);
        list.AddLine(a, b, outline, 3);
        list.AddLine(a, b, selection_colour, 1);
    }
}

void draw_pins(const std::vector<PickedPlace>& pins, Marks& marks) {
    const size_t step = std::max<size_t>(1, (pins.size() + most_pins - 1) / most_pins);
    for (size_t i = 0; i < pins.size(); i += step) {
        marks.square(pins[i].position, 3, outline);
        marks.square(pins[i].position, 2, pin_colour);
    }
}

} // namespace

void draw_selection_marks(const Session& session, Marks& marks) {
    draw_pins(session.editor.lasting_pins(), marks);
    draw_outline(session.select.outline(), *ImGui::GetBackgroundDrawList());
}

} // namespace anvil

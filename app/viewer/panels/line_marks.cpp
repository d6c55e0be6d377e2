#include "app/viewer/panels/line_marks.h"

#include <imgui.h>

namespace anvil {

namespace {

constexpr ImU32 outline = IM_COL32(20, 20, 24, 200);
constexpr ImU32 line_colour = IM_COL32(64, 150, 255, 255);
constexpr ImU32 next_colour = IM_COL32(255, 255, 255, 120);

void draw_picked(const PickedLine& line, Marks& marks) {
    const std::vector<Vec3> places = line.places();
    for (const auto& [colour, width] : {std::pair(outline, 4.5), std::pair(line_colour, 2.5)}) {
        for (size_t i = 0; i + 1 < places.size(); ++i) {
            marks.line(places[i], places[i + 1], width, colour);
        }
    }
    for (const PickedPlace& point : line.points) {
        marks.disc(point.position, 4.5, outline);
        marks.disc(point.position, 3, line_colour);
    }
}

} // namespace

void draw_line_marks(const Session& session, Marks& marks) {
    for (const PickedHandle& handle : session.editor.handles()) {
        for (const PickedLine& line : handle.anchor_lines) {
            draw_picked(line, marks);
        }
    }
    const PickedLine& drawn = session.line.line();
    draw_picked(drawn, marks);
    const std::optional<Vec3> cursor = session.under_cursor();
    if (!drawn.points.empty() && cursor && session.editor.tool == Tool::line) {
        marks.line(drawn.points.back().position, *cursor, 1.5, next_colour);
    }
}

} // namespace anvil

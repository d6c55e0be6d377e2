#include "app/viewer/panels/line_marks.h"

#include <imgui.h>

namespace anvil {

namespace {

constexpr ImU32 outline = IM_COL32(20, 20, 24, 200);
constexpr ImU32 line_colour = IM_COL32(64, 150, 255, 255);
constexpr ImU32 next_colour = IM_COL32(255, 255, 255, 120);

class Pen {
  public:
    explicit Pen(const OrbitCamera& camera) : camera_(camera), list_(*ImGui::GetBackgroundDrawList()) {}

    void line(const PickedLine& line) {
        const std::vector<Vec3> places = line.places();
        for (const auto& [colour, width] : {std::pair(outline, 4.5F), std::pair(line_colour, 2.5F)}) {
            for (size_t i = 0; i + 1 < places.size(); ++i) {
                segment(places[i], places[i + 1], colour, width);
            }
        }
        for (const PickedPlace& point : line.points) {
            if (const auto at = seen(point.position)) {
                list_.AddCircleFilled(*at, 4.5F, outline);
                list_.AddCircleFilled(*at, 3, line_colour);
            }
        }
    }

    void segment(const Vec3& a, const Vec3& b, ImU32 colour, float width) {
        const auto from = seen(a);
        const auto to = seen(b);
        if (from && to) {
            list_.AddLine(*from, *to, colour, width);
        }
    }

  private:
    std::optional<ImVec2> seen(const Vec3& place) const {
        const ScreenPoint at = camera_.project(place);
        return at.visible() ? std::optional(ImVec2(static_cast<float>(at.x), static_cast<float>(at.y)))
                            : std::nullopt;
    }

    const OrbitCamera& camera_;
    ImDrawList& list_;
};

} // namespace

void draw_line_marks(const Session& session) {
    Pen pen(session.camera);
    for (const PickedHandle& handle : session.editor.handles()) {
        for (const PickedLine& line : handle.anchor_lines) {
            pen.line(line);
        }
    }
    const PickedLine& drawn = session.line.line();
    pen.line(drawn);
    const std::optional<Vec3> cursor = session.under_cursor();
    if (!drawn.points.empty() && cursor && session.editor.tool == Tool::line) {
        pen.segment(drawn.points.back().position, *cursor, next_colour, 1.5F);
    }
}

} // namespace anvil

#include "app/viewer/panels/overlay.h"

#include "app/viewer/panels/gizmo_overlay.h"
#include "app/viewer/panels/line_marks.h"
#include "app/viewer/panels/selection_marks.h"

#include <imgui.h>

namespace anvil {

namespace {

constexpr ImU32 outline = IM_COL32(20, 20, 24, 230);
constexpr ImU32 handle_colour = IM_COL32(255, 176, 32, 255);
constexpr ImU32 mirrored_colour = IM_COL32(190, 150, 80, 255);
constexpr ImU32 target_colour = IM_COL32(255, 255, 255, 255);
constexpr ImU32 anchor_colour = IM_COL32(64, 150, 255, 255);
constexpr ImU32 pin_colour = IM_COL32(230, 90, 160, 255);
constexpr ImU32 hover_colour = IM_COL32(255, 255, 255, 190);
constexpr float apart_pixels = 3; ///< target and handle closer than this are one mark

class Marks {
  public:
    explicit Marks(const OrbitCamera& camera) : camera_(camera), list_(*ImGui::GetBackgroundDrawList()) {}

    void disc(const Vec3& place, float radius, ImU32 colour) {
        if (const auto at = window_place(place)) {
            list_.AddCircleFilled(*at, radius + 1.5F, outline);
            list_.AddCircleFilled(*at, radius, colour);
        }
    }

    void ring(const Vec3& place, float radius, ImU32 colour) {
        if (const auto at = window_place(place)) {
            list_.AddCircle(*at, radius, outline, 0, 4);
            list_.AddCircle(*at, radius, colour, 0, 2);
        }
    }

    void square(const Vec3& place, float half, ImU32 colour) {
        if (const auto at = window_place(place)) {
            const ImVec2 low(at->x - half, at->y - half);
            const ImVec2 high(at->x + half, at->y + half);
            list_.AddRectFilled(ImVec2(low.x - 1.5F, low.y - 1.5F), ImVec2(high.x + 1.5F, high.y + 1.5F),
                                outline);
            list_.AddRectFilled(low, high, colour);
        }
    }

    void line(const Vec3& a, const Vec3& b, ImU32 colour, float width) {
        const auto from = window_place(a);
        const auto to = window_place(b);
        if (from && to) {
            list_.AddLine(*from, *to, outline, width + 2);
            list_.AddLine(*from, *to, colour, width);
        }
    }

    bool apart(const Vec3& a, const Vec3& b) const {
        const ScreenPoint p = camera_.project(a);
        const ScreenPoint q = camera_.project(b);
        return std::hypot(p.x - q.x, p.y - q.y) > apart_pixels;
    }

  private:
    std::optional<ImVec2> window_place(const Vec3& place) const {
        const ScreenPoint at = camera_.project(place);
        if (!at.visible()) {
            return std::nullopt;
        }
        return ImVec2(static_cast<float>(at.x), static_cast<float>(at.y));
    }

    const OrbitCamera& camera_;
    ImDrawList& list_;
};

} // namespace

void draw_overlay(const Session& session) {
    draw_contact(session);
    const Editor& editor = session.editor;
    Marks marks(session.camera);
    if (editor.hover() && !editor.dragging()) {
        const SurfaceHit& hit = *editor.hover();
        const double tip = 14 * session.camera.pixel_size(session.camera.project(hit.position).depth);
        marks.line(hit.position, hit.position + tip * hit.normal, hover_colour, 1.5F);
        marks.ring(hit.position, 5, hover_colour);
    }
    const std::optional<DragView>& drag = session.shown().drag;
    for (size_t i = 0; i < editor.handles().size(); ++i) {
        const PickedHandle& handle = editor.handles()[i];
        const Vec3 target = editor.target(handle);
        const bool known = drag && i < drag->ends.size();
        const Vec3 end = known ? drag->ends[i] : target;
        for (const PickedPlace& anchor : handle.anchors) {
            marks.square(anchor.position, 4, anchor_colour);
        }
        if (marks.apart(handle.place.position, target)) {
            marks.line(handle.place.position, target, handle_colour, 1.5F);
            marks.disc(handle.place.position, 2.5F, handle_colour);
        }
        if (marks.apart(end, target)) { // an occluder keeps it from where it is wanted
            marks.line(end, target, target_colour, 1.5F);
            marks.ring(target, 7, target_colour);
        }
        marks.disc(end, i == editor.active() ? 6.5F : 5.0F, handle_colour);
    }
    draw_selection_marks(session);
    draw_line_marks(session);
    for (size_t i = editor.handles().size(); drag && i < drag->ends.size(); ++i) {
        marks.disc(drag->ends[i], 3.5F, mirrored_colour); // of the other side
    }
    for (const PickedPlace& pin : editor.pins()) {
        marks.square(pin.position, 4, pin_colour);
    }
    draw_gizmo(session);
}

} // namespace anvil

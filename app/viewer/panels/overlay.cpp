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

constexpr double rim = 1.5; ///< of the outline, pixels

void draw_disc(Marks& marks, const Vec3& place, double radius, ImU32 colour) {
    marks.disc(place, radius + rim, outline);
    marks.disc(place, radius, colour);
}

void draw_ring(Marks& marks, const Vec3& place, double radius, ImU32 colour) {
    marks.ring(place, radius, 4, outline);
    marks.ring(place, radius, 2, colour);
}

void draw_square(Marks& marks, const Vec3& place, double half, ImU32 colour) {
    marks.square(place, half + rim, outline);
    marks.square(place, half, colour);
}

void draw_line(Marks& marks, const Vec3& a, const Vec3& b, ImU32 colour) {
    marks.line(a, b, 3.5, outline);
    marks.line(a, b, 1.5, colour);
}

bool apart(const OrbitCamera& camera, const Vec3& a, const Vec3& b) {
    const ScreenPoint p = camera.project(a);
    const ScreenPoint q = camera.project(b);
    return std::hypot(p.x - q.x, p.y - q.y) > apart_pixels;
}

void draw_hover(const SurfaceHit& hit, Marks& marks) {
    const OrbitCamera& camera = marks.camera();
    const double tip = 14 * camera.pixel_size(camera.project(hit.position).depth) * camera.unit;
    draw_line(marks, hit.position, hit.position + tip * hit.normal, hover_colour);
    draw_ring(marks, hit.position, 5, hover_colour);
}

/// `end`: where the handle is.
void draw_handle(const PickedHandle& handle, const Vec3& target, const Vec3& end, bool active, Marks& marks) {
    for (const PickedPlace& anchor : handle.anchors) {
        draw_square(marks, anchor.position, 4, anchor_colour);
    }
    if (apart(marks.camera(), handle.place.position, target)) {
        draw_line(marks, handle.place.position, target, handle_colour);
        draw_disc(marks, handle.place.position, 2.5, handle_colour);
    }
    if (apart(marks.camera(), end, target)) { // an occluder keeps it from where it is wanted
        draw_line(marks, end, target, target_colour);
        draw_ring(marks, target, 7, target_colour);
    }
    draw_disc(marks, end, active ? 6.5 : 5.0, handle_colour);
}

} // namespace

void draw_overlay(const Session& session, Marks& marks) {
    draw_contact(session, marks);
    const Editor& editor = session.editor;
    if (editor.hover() && !editor.dragging()) {
        draw_hover(*editor.hover(), marks);
    }
    const std::optional<DragView>& drag = session.shown().drag;
    for (size_t i = 0; i < editor.handles().size(); ++i) {
        const PickedHandle& handle = editor.handles()[i];
        const Vec3 target = editor.target(handle);
        const bool known = drag && i < drag->ends.size();
        draw_handle(handle, target, known ? drag->ends[i] : target, i == editor.active(), marks);
    }
    draw_selection_marks(session, marks);
    draw_line_marks(session, marks);
    for (size_t i = editor.handles().size(); drag && i < drag->ends.size(); ++i) {
        draw_disc(marks, drag->ends[i], 3.5, mirrored_colour); // of the other side
    }
    for (const PickedPlace& pin : editor.pins()) {
        draw_square(marks, pin.position, 4, pin_colour);
    }
    draw_ways(session, marks);
    draw_gizmo(session);
}

} // namespace anvil

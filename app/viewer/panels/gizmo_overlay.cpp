#include "app/viewer/panels/gizmo_overlay.h"

#include <array>
#include <imgui.h>

namespace anvil {

namespace {

constexpr ImU32 outline = IM_COL32(20, 20, 24, 200);
constexpr ImU32 neutral = IM_COL32(225, 225, 230, 255);
constexpr ImU32 hot_colour = IM_COL32(255, 214, 64, 255);
/// Told apart by people who do not see red and green apart: vermilion, bluish green, sky blue.
constexpr std::array<ImU32, 3> axis_colours{IM_COL32(226, 98, 38, 255), IM_COL32(20, 176, 130, 255),
                                            IM_COL32(92, 178, 240, 255)};
constexpr ImU32 touching_colour = IM_COL32(235, 60, 110, 110);
constexpr ImU32 touching_vertex = IM_COL32(255, 90, 140, 230);
constexpr ImU32 deepest_colour = IM_COL32(255, 255, 255, 255);
constexpr ImU32 way_colour = IM_COL32(255, 214, 64, 220);

ImVec2 narrow(const glm::dvec2& place) {
    return {static_cast<float>(place.x), static_cast<float>(place.y)};
}

ImU32 colour_of(const GizmoPart& part) {
    const bool has_axis = part.action == GizmoAction::move || part.action == GizmoAction::across ||
                          part.action == GizmoAction::turn;
    return has_axis ? axis_colours[static_cast<size_t>(part.axis)] : neutral;
}

ImU32 with_alpha(ImU32 colour, ImU32 alpha) {
    return (colour & ~IM_COL32_A_MASK) | (alpha << IM_COL32_A_SHIFT);
}

/// The head of an arrow from a to b.
void draw_tip(ImDrawList& list, const ImVec2& a, const ImVec2& b, ImU32 colour) {
    const glm::vec2 way(b.x - a.x, b.y - a.y);
    const float length = glm::length(way);
    if (length < 1) {
        return;
    }
    const glm::vec2 along = way / length;
    const glm::vec2 across(-along.y, along.x);
    const glm::vec2 tip = glm::vec2(b.x, b.y) + 7.0F * along;
    const glm::vec2 left = glm::vec2(b.x, b.y) - 5.0F * along + 5.0F * across;
    const glm::vec2 right = glm::vec2(b.x, b.y) - 5.0F * along - 5.0F * across;
    list.AddTriangleFilled({tip.x, tip.y}, {left.x, left.y}, {right.x, right.y}, colour);
}

void draw_mark(ImDrawList& list, const GizmoMark& mark, bool hot, float unit) {
    std::vector<ImVec2> line;
    for (const glm::dvec2& place : mark.line) {
        line.push_back(narrow(place));
    }
    const auto count = static_cast<int>(line.size());
    if (count < 2) {
        return;
    }
    const ImU32 colour = hot ? hot_colour : colour_of(mark.part);
    if (mark.filled) {
        list.AddConvexPolyFilled(line.data(), count, with_alpha(colour, 150));
        list.AddPolyline(line.data(), count, colour, ImDrawFlags_Closed, 1.5F * unit);
        return;
    }
    list.AddPolyline(line.data(), count, outline, 0, (hot ? 5.5F : 4.0F) * unit);
    list.AddPolyline(line.data(), count, colour, 0, (hot ? 3.5F : 2.0F) * unit);
    if (mark.part.action == GizmoAction::move) {
        draw_tip(list, line.front(), line.back(), colour);
    }
}

void draw_way(Marks& marks, const std::vector<Vec3>& places) {
    for (const auto& [colour, width] : {std::pair(outline, 4.0), std::pair(way_colour, 2.0)}) {
        for (size_t i = 1; i < places.size(); ++i) {
            marks.line(places[i - 1], places[i], width, colour);
        }
    }
}

/// What of the scene touches now, of the drag or of the surface as it stands.
const LiveContact* contact_of(const Shown& shown) {
    if (shown.drag) {
        return shown.drag->contact ? &shown.drag->contact->touching : nullptr;
    }
    return shown.standing ? &*shown.standing : nullptr;
}

} // namespace

void draw_contact(const Session& session, Marks& marks) {
    const LiveContact* contact = contact_of(session.shown());
    if (contact == nullptr || !session.view.occluders) {
        return;
    }
    for (const auto& facet : contact->facets) {
        const bool faces_eye = glm::dot(glm::cross(facet[1] - facet[0], facet[2] - facet[0]),
                                        facet[0] - session.camera.eye()) < 0;
        if (faces_eye) {
            marks.facet(facet[0], facet[1], facet[2], touching_colour);
        }
    }
    for (const Vec3& mark : contact->marks) {
        marks.square(mark, 1, touching_vertex);
    }
    for (const auto& [colour, width] : {std::pair(outline, 4.0), std::pair(deepest_colour, 2.0)}) {
        if (contact->vertex) {
            marks.ring(contact->vertex->position, 6, width, colour);
        }
        if (contact->triangle) {
            marks.triangle(contact->triangle->position, 8, width, colour);
        }
    }
}

/// Of recorded hammers, and of handles whose path counts.
void draw_ways(const Session& session, Marks& marks) {
    for (const PickedHandle& handle : session.editor.handles()) {
        std::vector<Vec3> places;
        for (const Vec3& offset : handle.way) {
            places.push_back(handle.place.position + offset);
        }
        draw_way(marks, places);
    }
    for (const auto& [name, poses] : session.occluders.samples()) {
        const OccluderView* occluder = nullptr;
        for (const OccluderView& view : session.shown().occluders) {
            occluder = view.name == name ? &view : occluder;
        }
        if (occluder == nullptr) {
            continue;
        }
        std::vector<Vec3> places;
        for (const Transform& pose : poses) {
            places.push_back(placed_point(pose, occluder->pivot));
        }
        draw_way(marks, places);
    }
}

void draw_gizmo(const Session& session) {
    if (!session.view.occluders) {
        return;
    }
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const GizmoMark& mark : session.occluders.marks(session.camera, session.shown().occluders)) {
        draw_mark(list, mark, mark.part == session.occluders.hot(), static_cast<float>(session.camera.unit));
    }
}

} // namespace anvil

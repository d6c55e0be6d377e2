// What a session does with what is selected.
#include "app/viewer/selected_places.h"
#include "app/viewer/session.h"
#include "app/viewer/window.h"

namespace anvil {

namespace {

constexpr size_t most_anchors = 2000; ///< of a handle: each two are compared
constexpr double least_frame = 0.05;  ///< of the surface's diagonal: a single vertex has no extent

/// The points' box a little larger where it is small.
std::vector<Vec3> with_room(std::vector<Vec3> points, double room) {
    Box box;
    for (const Vec3& p : points) {
        box.include(p);
    }
    if (box.diagonal() < room) {
        points = {box.centre() - Vec3(0.3 * room), box.centre() + Vec3(0.3 * room)};
    }
    return points;
}

} // namespace

void Session::change_selection(const SelectionChange& change) {
    ask("selecting", [this, change](Progress&) { bench_->select(change); });
}

void Session::change_selection(SelectionChange::Kind kind) {
    SelectionChange change;
    change.kind = kind;
    change_selection(change);
}

void Session::pin_selection() {
    if (shown_->look->selected_count == 0) {
        complain("nothing is selected that could be pinned");
        return;
    }
    editor.set_lasting_pins(
        places_of(*shown_->document.surface, shown_->look->selection.selected_vertices(), *shown_->pick));
}

void Session::anchor_selection() {
    if (!editor.has_handles() || shown_->look->selected_count == 0) {
        complain("anchors want a handle and a selection");
        return;
    }
    const SelectedPlaces places =
        faces_and_places_of(*shown_->document.surface, shown_->look->selection, *shown_->pick);
    const size_t count = places.faces.size() + places.places.size();
    if (count > most_anchors) {
        complain(std::to_string(count) + " faces and vertices are selected; a handle can have " +
                 std::to_string(most_anchors) + " anchors, so select fewer, or draw a line around them");
        return;
    }
    editor.add_anchors(places.faces, places.places);
}

void Session::frame_selection() {
    if (!shown_->mesh) {
        return;
    }
    const std::span<const Vec3> positions = shown_->document.surface->positions;
    std::vector<uint32_t> vertices = shown_->look->selection.selected_vertices();
    if (vertices.empty() && shown_->region) {
        vertices = shown_->region->vertices;
    }
    std::vector<Vec3> points;
    points.reserve(vertices.size());
    for (const uint32_t v : vertices) {
        points.push_back(positions[v]);
    }
    if (points.empty()) {
        frame_all();
    } else {
        camera.frame(with_room(std::move(points), least_frame * bounds().diagonal()));
    }
}

bool Session::handle_selection(const InputEvent& event) {
    const bool is_move =
        event.kind == InputEvent::Kind::move; // the tool knows the cursor before its first press
    if ((is_move || editor.tool == Tool::select) && select.handle(event, camera)) {
        if (const auto change = select.take()) {
            change_selection(*change);
        }
        return true;
    }
    return event.kind == InputEvent::Kind::key_down && command_of_selection(event);
}

bool Session::command_of_selection(const InputEvent& event) {
    const Modifiers& held = event.modifiers;
    if (const auto kind = selection_key(event)) {
        change_selection(*kind);
    } else if (event.key == 'B' && !held.control && !held.alt) {
        editor.tool = Tool::select;
        select.lasso = held.shift;
    } else if (event.key == 'V' && editor.tool == Tool::select && !held.control) {
        select.through = !select.through;
    } else if (event.key == 'P' && held.control) {
        held.shift ? editor.set_lasting_pins({}) : pin_selection();
    } else if (event.key == 'A' && held.shift && !held.control) {
        anchor_selection();
    } else if (event.key == key_of("escape") && editor.tool == Tool::select && !editor.has_handles()) {
        change_selection(SelectionChange::Kind::none);
    } else {
        return false;
    }
    return true;
}

} // namespace anvil

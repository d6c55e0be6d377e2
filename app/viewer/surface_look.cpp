#include "app/viewer/surface_look.h"

#include "app/viewer/coarse_triangles.h"
#include "app/viewer/select_region.h"

namespace anvil {

namespace {

/// Fewer triangles are drawn fast enough as they are.
constexpr size_t many_triangles = 150'000;
constexpr size_t coarse_count = 60'000;

/// Keeps the surface that it picks on.
struct KeptPick {
    std::shared_ptr<const SurfaceVersion> surface;
    PickSurface pick;

    explicit KeptPick(std::shared_ptr<const SurfaceVersion> version)
        : surface(std::move(version)), pick(*surface->mesh, *surface->history, surface->positions) {}
    KeptPick(std::shared_ptr<const SurfaceVersion> version, std::vector<uint32_t> triangles)
        : surface(std::move(version)),
          pick(*surface->mesh, *surface->history, surface->positions, std::move(triangles)) {}
};

template <class... Arguments>
std::shared_ptr<const PickSurface> kept_pick(Arguments&&... arguments) {
    const auto kept = std::make_shared<const KeptPick>(std::forward<Arguments>(arguments)...);
    return {kept, &kept->pick};
}

std::vector<uint32_t> shown_triangles(const Mesh& mesh, const Selection& selection) {
    std::vector<uint32_t> triangles;
    for (size_t f = 0; f < mesh.polygon_count(); ++f) {
        if (!selection.hides(mesh.polygon(f))) {
            for (size_t t = mesh.first_triangle(f); t < mesh.first_triangle(f + 1); ++t) {
                triangles.push_back(static_cast<uint32_t>(t));
            }
        }
    }
    return triangles;
}

/// What is left of the faces, on all the vertices.
Mesh shown_faces(const Mesh& mesh, const Selection& selection, const std::vector<uint32_t>& triangles) {
    Mesh shown;
    shown.positions = mesh.positions;
    for (size_t f = 0; f < mesh.polygon_count(); ++f) {
        if (!selection.hides(mesh.polygon(f))) {
            shown.add_polygon(mesh.polygon(f));
        }
    }
    for (const uint32_t t : triangles) {
        shown.triangles.push_back(mesh.triangles[t]);
    }
    return shown;
}

bool same_hidden(const Selection& a, const Selection& b) {
    bool same = a.vertex_count() == b.vertex_count();
    for (size_t v = 0; same && v < a.vertex_count(); ++v) {
        same = a.hidden(v) == b.hidden(v);
    }
    return same;
}

std::shared_ptr<const Buffer> selected_buffer(DeviceState& device, const Selection& selection) {
    std::vector<uint32_t> marks(selection.vertex_count());
    for (size_t v = 0; v < marks.size(); ++v) {
        marks[v] = selection.selected(v) ? 1 : 0;
    }
    return std::make_shared<const Buffer>(storage_buffer(device, std::span<const uint32_t>(marks)));
}

} // namespace

void SurfaceLooks::follow(std::shared_ptr<const SurfaceVersion> surface) {
    Selection selection = look_->selection;
    if (surface_ && surface_->file == surface->file) {
        selection.follow(surface->mesh->vertex_count(), surface_->history->parents(),
                         surface->history->parents());
    } else {
        selection.reset(surface->mesh->vertex_count());
    }
    std::shared_ptr<const PickSurface> whole = kept_pick(surface);
    surface_.swap(surface);
    whole_.swap(whole);
    try {
        show(std::move(selection));
    } catch (...) {
        surface_.swap(surface);
        whole_.swap(whole);
        throw;
    }
}

void SurfaceLooks::change(const SelectionChange& change) {
    if (surface_) {
        Selection selection = look_->selection;
        apply(change, selection);
        show(std::move(selection));
    }
}

void SurfaceLooks::apply(const SelectionChange& change, Selection& selection) const {
    using Kind = SelectionChange::Kind;
    switch (change.kind) {
    case Kind::region:
        selection.change(change.outline.size() == 1
                             ? vertices_under(change.camera, change.outline[0], *look_->pick)
                             : vertices_within(change.camera, change.outline, *look_->pick, change.through),
                         change.mode);
        break;
    case Kind::all:
        selection.select_all();
        break;
    case Kind::none:
        selection.select_none();
        break;
    case Kind::invert:
        selection.invert();
        break;
    case Kind::grow:
        selection.grow(*surface_->mesh);
        break;
    case Kind::shrink:
        selection.shrink(*surface_->mesh);
        break;
    case Kind::hide_selected:
        selection.hide_selected();
        break;
    case Kind::hide_unselected:
        selection.hide_unselected();
        break;
    case Kind::show_all:
        selection.show_all();
        break;
    }
}

void SurfaceLooks::show(Selection selection) {
    auto next = std::make_shared<SurfaceLook>();
    next->selected_count = selection.selected_count();
    next->hidden_count = selection.hidden_count();
    const bool same_faces = looked_at_ == surface_->mesh && same_hidden(selection, look_->selection);
    next->selection = std::move(selection);
    if (next->selected_count > 0) {
        next->selected = selected_buffer(device_, next->selection);
    }
    if (same_faces) {
        next->coarse = look_->coarse;
    }
    next->pick = whole_;
    if (next->hidden_count > 0) {
        leave_out_hidden(*next);
    }
    looked_at_ = surface_->mesh;
    look_ = std::move(next);
}

void SurfaceLooks::leave_out_hidden(SurfaceLook& look) const {
    const std::vector<uint32_t> triangles = shown_triangles(*surface_->mesh, look.selection);
    if (triangles.size() == surface_->mesh->triangles.size()) {
        return;
    }
    const Mesh shown = shown_faces(*surface_->mesh, look.selection, triangles);
    look.indices = std::make_shared<const DrawnIndices>(device_, shown, surface_->positions);
    look.pick = kept_pick(surface_, triangles);
}

void SurfaceLooks::add_coarse() {
    if (!surface_ || look_->coarse || surface_->mesh->triangles.size() < many_triangles) {
        return;
    }
    std::vector<Triangle> shown;
    for (const uint32_t t : shown_triangles(*surface_->mesh, look_->selection)) {
        shown.push_back(surface_->mesh->triangles[t]);
    }
    if (shown.size() < many_triangles) {
        return;
    }
    auto next = std::make_shared<SurfaceLook>(*look_);
    next->coarse = std::make_shared<const DrawnIndices>(
        device_, std::span<const uint32_t>(coarse_triangles(surface_->positions, shown, coarse_count)));
    look_ = std::move(next);
}

} // namespace anvil

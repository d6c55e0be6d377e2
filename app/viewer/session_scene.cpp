// What a session shows of its state.
#include "app/viewer/session.h"

#include "engine/occluder/shape_nodes.h"

#include <algorithm>
#include <cmath>

namespace anvil {

namespace {

constexpr double room_step = 0.25; ///< of a box's diagonal
constexpr std::chrono::milliseconds motion_after_zoom(200);
const glm::vec4 occluder_colour(0.17F, 0.34F, 0.52F, 0.42F);
const glm::vec4 selected_colour(0.15F, 0.42F, 0.72F, 0.5F);
const glm::vec4 off_colour(0.3F, 0.3F, 0.3F, 0.12F);

glm::mat4 model_view(const OrbitCamera& camera, const Transform& transform) {
    const Placement place = placement(transform);
    const glm::dmat3 axes(place.axes[0] * place.scale, place.axes[1] * place.scale,
                          place.axes[2] * place.scale);
    return camera.view(place.origin) * glm::mat4(glm::mat3(axes));
}

/// What is dragged may leave the box. In large steps: depths stay comparable from one scene of a drag to the
/// next.
Box with_room_for(const Box& box, const std::vector<Vec3>& ends, double radius) {
    double beyond = 0;
    for (const Vec3& end : ends) {
        const Vec3 out = glm::max(box.low - end, end - box.high) + Vec3(radius);
        beyond = std::max({beyond, out.x, out.y, out.z});
    }
    const double step = room_step * box.diagonal();
    const double room = beyond > 0 && step > 0 && std::isfinite(beyond) ? std::ceil(beyond / step) * step : 0;
    return {box.low - Vec3(room), box.high + Vec3(room)};
}

/// Translucent things with how far they are from the eye.
using Translucent = std::vector<std::pair<double, SceneItem>>;

} // namespace

SceneItem Session::surface_item() const {
    SceneItem surface;
    surface.mesh = shown_->mesh;
    surface.region = shown_->region;
    surface.model_view = camera.view(shown_->mesh->origin);
    const bool coarse = view.less_in_motion && in_motion() && shown_->look->coarse;
    surface.indices = coarse ? shown_->look->coarse : shown_->look->indices;
    surface.selected = shown_->look->selected;
    if (shown_->outcome) {
        surface.mesh = shown_->outcome->mesh;
        surface.region.reset();
        surface.indices.reset();
        surface.selected.reset();
    }
    surface.lights = view.lights;
    surface.flat = view.flat;
    surface.edges = view.edges;
    surface.tinted = view.tint;
    surface.contour_spacing = view.contours ? static_cast<float>(editor.radius / 10) : 0.0F;
    // The line at the radius itself would be drawn in bits: no triangle there has an outer side.
    surface.contour_end = 9.5F * surface.contour_spacing;
    return surface;
}

bool Session::in_motion() const {
    return navigation.active() || std::chrono::steady_clock::now() - zoomed_at_ < motion_after_zoom;
}

Scene Session::scene() const {
    Scene scene;
    if (!shown_->mesh) {
        return scene;
    }
    scene.items.push_back(surface_item());
    Box all = bounds();
    if (shown_->drag) {
        all = with_room_for(all, shown_->drag->ends, editor.radius);
    }
    Translucent translucent;
    if (editor.mirror) {
        const MirrorPlane::Place plane = mirror_plane_.place(*editor.mirror, bounds());
        SceneItem item = mirror_plane_.item();
        item.model_view = camera.view(plane.origin) * glm::mat4(plane.axes);
        for (const Vec3& corner : plane.corners()) {
            all.include(corner);
        }
        translucent.emplace_back(camera.project(plane.origin).depth, std::move(item));
    }
    if (view.occluders) {
        for (const OccluderView& occluder : shown_->occluders) {
            SceneItem item;
            item.mesh = occluder.mesh;
            const Transform at = occluders.shown(occluder);
            item.model_view = model_view(camera, at);
            item.colour = shown_->document.off.contains(occluder.name) ? off_colour
                          : occluder.name == occluders.selected()      ? selected_colour
                                                                       : occluder_colour;
            item.tinted = false;
            const Placement place = placement(at);
            if (item.mesh->box.empty()) {
                continue;
            }
            const double reach =
                place.scale * (glm::length(item.mesh->box.centre()) + item.mesh->box.diagonal());
            all.include(place.origin - Vec3(reach));
            all.include(place.origin + Vec3(reach));
            translucent.emplace_back(camera.project(place.origin).depth, std::move(item));
        }
    }
    std::stable_sort(translucent.begin(), translucent.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (auto& [depth, item] : translucent) {
        scene.items.push_back(std::move(item));
    }
    scene.projection = camera.projection(all);
    scene.orthographic = camera.orthographic;
    return scene;
}

} // namespace anvil

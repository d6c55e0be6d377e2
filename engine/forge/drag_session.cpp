#include "engine/forge/drag_session.h"

#include "engine/forge/mirror_edit.h"

namespace anvil {

namespace {

const std::string place = "edit";

/// What the distances depend on, apart from the radii: all else as in an empty edit.
Edit question_of(const Edit& edit) {
    Edit question;
    question.anchors = edit.anchors;
    question.pinned = edit.pinned;
    question.metric = edit.metric;
    question.method = edit.method;
    question.smooth_surface = edit.smooth_surface;
    for (const Handle& handle : edit.handles) {
        question.handles.emplace_back().at = handle.at;
        question.handles.back().metric = handle.metric;
    }
    return question;
}

bool same_shapes(const Edit& a, const Edit& b) {
    bool same = a.shape == b.shape;
    for (size_t j = 0; j < a.handles.size(); ++j) {
        same = same && a.handles[j].shape == b.handles[j].shape;
    }
    return same;
}

} // namespace

DragSession::DragSession(DragScene& scene, const EditOccluders& occluders, Backend& backend, const Edit& edit,
                         Log& log)
    : scene_(scene), marches_(scene.surface()), backend_(backend, log), log_(log) {
    update(edit, occluders);
}

std::optional<std::vector<double>> DragSession::radii_within_measured(const Edit& edit) const {
    if (!now_.measured || question_of(edit) != question_of(now_.edit)) {
        return std::nullopt;
    }
    std::vector<double> radii;
    for (size_t j = 0; j < now_.measured->radii.size(); ++j) {
        const std::optional<double> given = given_radius(edit, j);
        // Without one the default holds, which wants the whole field.
        if (given ? !(*given <= now_.measured->radii[j]) : given_radius(now_.edit, j).has_value()) {
            return std::nullopt;
        }
        radii.push_back(given.value_or(now_.measured->radii[j]));
    }
    return radii;
}

void DragSession::update(const Edit& given, const EditOccluders& occluders) {
    const Edit edit = on_both_sides(given, place, scene_.surface(), scene_.frame().diagonal);
    const std::optional<std::vector<double>> radii = radii_within_measured(edit);
    if (!radii) {
        auto measured = std::make_shared<const EditDistances>(
            measure_distances(edit, place, scene_.surface(), [this](std::span<const DistanceQuery> queries) {
                return marches_.distances(queries);
            }));
        ++work_.distances;
        now_ = opened(edit, occluders, measured, measured->radii);
    } else if (*radii != now_.region.radii) {
        now_ = opened(edit, occluders, now_.measured, *radii);
    } else {
        change(edit, occluders);
    }
    now_.session->update(now_.motion.motion);
    ++work_.updates;
}

DragSession::Stage DragSession::opened(const Edit& edit, const EditOccluders& occluders,
                                       std::shared_ptr<const EditDistances> measured,
                                       const std::vector<double>& radii) {
    Stage stage;
    stage.edit = edit;
    stage.measured = std::move(measured);
    stage.region = region_within(edit, *stage.measured, radii, scene_.positions(), scene_.numbers());
    OccluderSet set = set_for(edit, occluders, stage.region);
    stage.uses = occluders.uses_of(edit);
    stage.models = occluders.models_of(stage.uses);
    stage.motion = motion_of(edit, stage.region, set);
    const Vec3& origin = scene_.frame().origin;
    stage.input =
        std::make_shared<DeformInput>(deform_input(stage.region, scene_.positions(), origin, std::move(set)));
    RegionFans fans = fans_around(stage.region.vertices, scene_.mesh(), scene_.incidence(),
                                  scene_.positions(), origin, scene_.numbers());
    stage.input->fans = std::move(fans.fans);
    stage.normal_vertices = std::move(fans.vertices);
    stage.session = backend_.prepare(stage.input);
    ++work_.regions;
    return stage;
}

void DragSession::change(const Edit& edit, const EditOccluders& occluders) {
    std::vector<OccluderUse> uses = occluders.uses_of(edit);
    OccluderModels models = occluders.models_of(uses);
    const bool occluders_stand = uses == now_.uses && models == now_.models &&
                                 (!now_.input->occluders.moves() || edit.amount == now_.edit.amount);
    OccluderSet set = occluders_stand ? OccluderSet{} : set_for(edit, occluders, now_.region);
    if (models == now_.models) {
        set.field_words = now_.input->occluders.field_words; // the device has them
    }
    const bool shapes_stand = same_shapes(edit, now_.edit);
    std::vector<ShapeFunction> shapes = shapes_stand ? std::vector<ShapeFunction>{} : shapes_of(edit);
    const auto exchange_shapes = [&] {
        if (!shapes_stand) {
            std::swap(shapes, now_.region.shapes);
        }
    };
    exchange_shapes();
    try {
        now_.motion = motion_of(edit, now_.region, occluders_stand ? now_.input->occluders : set);
    } catch (...) {
        exchange_shapes();
        throw;
    }
    now_.edit = edit;
    if (!shapes_stand) {
        set_shapes(now_.region.shapes, *now_.input);
        now_.session->refresh_shapes();
        ++work_.shapes;
    }
    if (!occluders_stand) {
        now_.uses = std::move(uses);
        now_.models = std::move(models);
        now_.input->occluders = std::move(set);
        find_start_distances(*now_.input);
        now_.session->refresh_occluders();
        ++work_.occluders;
    }
}

OccluderSet DragSession::set_for(const Edit& edit, const EditOccluders& occluders,
                                 const EditRegion& region) const {
    const LocalFrame& frame = scene_.frame();
    return occluders.set_for(edit, {frame.origin, frame.diagonal, largest_radius(region, frame.diagonal)},
                             place);
}

EditMotion DragSession::motion_of(const Edit& edit, const EditRegion& region, const OccluderSet& set) {
    return find_motion(edit, region, scene_.positions(), scene_.frame().origin, place, set, log_);
}

void DragSession::wait() {
    now_.session->wait();
}

std::vector<Vec3> DragSession::positions() {
    const std::vector<PointResult> results = now_.session->download();
    std::vector<Vec3> places;
    places.reserve(results.size());
    for (size_t i = 0; i < results.size(); ++i) {
        places.push_back(scene_.positions()[now_.region.vertices[i]] + results[i].displacement);
    }
    return places;
}

std::vector<Vec3> DragSession::normals() {
    return now_.session->download_normals();
}

} // namespace anvil

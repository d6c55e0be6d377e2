#include "engine/occluder/occluder_set.h"

#include "engine/core/error.h"
#include "engine/occluder/occluder_kernel.h"
#include "engine/occluder/shape_nodes.h"

#include <algorithm>
#include <cmath>

namespace anvil {

namespace {

namespace k = kernel::f64;

constexpr double steps_across = 128; // analytic shapes: h = diagonal / 128 (mathematics of contact)

template <class Sampled>
k::ShapeNode sampled_node(uint32_t kind, const Sampled& field) {
    k::ShapeNode node{};
    node.kind = kind;
    node.size = field.half_size;
    node.extra = field.voxel;
    node.axis_x = Vec3(1, 0, 0);
    node.axis_y = Vec3(0, 1, 0);
    node.axis_z = Vec3(0, 0, 1);
    node.origin = field.centre;
    node.scale = 1;
    return node;
}

bool bounded(const Box& box) {
    return is_finite(box.low) && is_finite(box.high);
}

/// Step width h and settle distance e of the model, in its own units times its scale.
void set_contact(k::Occluder& occluder, const OccluderModel& model, double size) {
    double h = size / steps_across;
    occluder.settle = 0;
    const auto take = [&](const auto& field) {
        h = field.voxel * occluder.scale;
        occluder.settle = field.error * occluder.scale;
    };
    if (!model.volumes.empty()) {
        take(*model.volumes.front());
    } else if (model.field) {
        take(*model.field);
    }
    occluder.margin = h;
    occluder.step = 0.5 * h;
}

void set_influence(OccluderSet& set, k::Occluder& occluder, const Influence& influence,
                   double fallback_sigma) {
    occluder.strength = influence.strength;
    occluder.width = influence.sigma.value_or(fallback_sigma);
    switch (influence.kind) {
    case InfluenceKind::paper:
        occluder.influence = k::INFLUENCE_PAPER;
        set.paper = true;
        break;
    case InfluenceKind::hard:
        occluder.influence = k::INFLUENCE_HARD;
        break;
    case InfluenceKind::soft:
        occluder.influence = k::INFLUENCE_SOFT;
        break;
    case InfluenceKind::curve:
        occluder.influence = k::INFLUENCE_CURVE;
        occluder.strength = 1;
        occluder.width = influence.width;
        const ShapeFunction curve(influence.knots);
        occluder.curve = {static_cast<uint32_t>(set.segments.size()),
                          static_cast<uint32_t>(curve.segments().size())};
        for (const auto& s : curve.segments()) {
            set.segments.push_back({s.begin, s.c0, s.c1, s.c2, s.c3});
        }
        break;
    }
}

/// @return where the field's words begin. A field that is alone is shared, not copied.
uint32_t add_words(OccluderSet& set, const std::shared_ptr<const AdaptiveField>& field) {
    if (!set.field_words) {
        set.field_words = {field, &field->words};
        return 0;
    }
    const size_t first = set.field_words->size();
    auto joined = std::make_shared<std::vector<uint32_t>>(*set.field_words);
    joined->insert(joined->end(), field->words.begin(), field->words.end());
    set.field_words = std::move(joined);
    return static_cast<uint32_t>(first);
}

SignedDistance in_world(const k::Occluder& occluder, const ExactDistance& exact, const Vec3& p) {
    const Vec3 arm = (p - occluder.origin) / occluder.scale;
    const Vec3 local(glm::dot(occluder.axis_x, arm), glm::dot(occluder.axis_y, arm),
                     glm::dot(occluder.axis_z, arm));
    const SignedDistance s = exact.at(local);
    return {s.distance * occluder.scale,
            occluder.axis_x * s.normal.x + occluder.axis_y * s.normal.y + occluder.axis_z * s.normal.z};
}

} // namespace

OccluderModel build_model(const OccluderShape& shape, const Field& field, Progress& progress,
                          const SolidSource& source, const FileCache* cache, SearchDevice* device) {
    OccluderModel model;
    if (has_formula(shape)) {
        model.nodes = shape_nodes(shape);
    }
    model.exact = field.kind == FieldKind::exact
                      ? solid_distance(shape, source)
                      : true_distance(shape, source, static_cast<int>(field.resolution));
    model.bounds = model.exact->bounds();
    if (model.bounds.empty()) {
        throw InputError(
            "the solid is empty: its parts leave nothing over; move them so that something remains");
    }
    if (field.kind == FieldKind::exact) {
        return model;
    }
    return sampled_model(model.exact, field, progress, bake_cache(cache, shape, field, source), device);
}

OccluderModel sampled_model(std::shared_ptr<const ExactDistance> solid, const Field& field,
                            Progress& progress, const BakeCache& cache, SearchDevice* device) {
    OccluderModel model;
    if (field.kind == FieldKind::dense) {
        model.volumes.push_back(std::make_shared<DistanceVolume>(
            cached<DistanceVolume>(cache, [&] { return bake(*solid, field.resolution, progress, device); })));
        model.nodes = {sampled_node(k::SHAPE_VOLUME, *model.volumes.front())};
    } else {
        model.field = std::make_shared<AdaptiveField>(cached<AdaptiveField>(
            cache, [&] { return bake_adaptive(*solid, field.resolution, progress, device); }));
        model.nodes = {sampled_node(k::SHAPE_BRICKS, *model.field)};
    }
    model.bounds = solid->bounds();
    model.exact = std::move(solid);
    return model;
}

void add_occluder(OccluderSet& set, const OccluderModel& model, const std::string& name,
                  const Transform& pose, const Influence& influence, const OccluderScale& scale) {
    if (set.volumes.size() + model.volumes.size() > k::MAX_VOLUMES) {
        throw InputError("occluder \"" + name + "\": an edit can use at most " +
                         std::to_string(k::MAX_VOLUMES) +
                         " densely baked occluders: give some an adaptive field, or leave some out");
    }
    const Placement place = placement(pose);
    k::Occluder occluder{};
    occluder.axis_x = place.axes[0];
    occluder.axis_y = place.axes[1];
    occluder.axis_z = place.axes[2];
    occluder.origin = place.origin - scale.origin;
    occluder.scale = place.scale;
    occluder.first_node = static_cast<uint32_t>(set.nodes.size());
    occluder.node_count = static_cast<uint32_t>(model.nodes.size());
    const double size = bounded(model.bounds) ? model.bounds.diagonal() * place.scale : scale.diagonal;
    set_contact(occluder, model, size);
    set_influence(set, occluder, influence,
                  default_soft_width * (bounded(model.bounds) ? 0.5 * size : scale.radius));
    set_box(occluder, model.bounds);

    const uint32_t first_word = model.field ? add_words(set, model.field) : 0;
    for (k::ShapeNode node : model.nodes) {
        node.volume += static_cast<uint32_t>(set.volumes.size());
        node.words += first_word;
        set.nodes.push_back(node);
    }
    set.volumes.insert(set.volumes.end(), model.volumes.begin(), model.volumes.end());
    set.occluders.push_back(occluder);
    set.exact.push_back(model.exact);
    set.sizes.push_back(size);
}

void set_box(k::Occluder& occluder, const Box& bounds) {
    occluder.boxed = 1;
    for (int i = 0; i < 3; ++i) {
        const bool ends = std::isfinite(bounds.low[i]) && std::isfinite(bounds.high[i]);
        occluder.box_centre[i] = ends ? 0.5 * (bounds.low[i] + bounds.high[i]) : 0;
        occluder.box_half[i] = ends ? 0.5 * (bounds.high[i] - bounds.low[i]) : infinity;
    }
}

double touching_distance(const OccluderSet& set, size_t occluder) {
    return 1e-9 * set.sizes[occluder];
}

SignedDistance exact_distance(const OccluderSet& set, size_t occluder, const Vec3& p) {
    return in_world(set.occluders[occluder], *set.exact[occluder], p);
}

SignedDistance exact_distance(const OccluderSet& set, const Vec3& p) {
    SignedDistance nearest{infinity, Vec3(0)};
    for (size_t i = 0; i < set.occluders.size(); ++i) {
        const SignedDistance s = exact_distance(set, i, p);
        if (s.distance < nearest.distance) {
            nearest = s;
        }
    }
    return nearest;
}

} // namespace anvil

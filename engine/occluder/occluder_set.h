// The occluders of one edit, ready for the kernels.
#pragma once

#include "engine/core/progress.h"
#include "engine/edit/recipe.h"
#include "engine/occluder/adaptive_field.h"
#include "engine/occluder/distance_volume.h"
#include "engine/occluder/exact_distance.h"
#include "engine/occluder/field_cache.h"
#include "engine/occluder/kernel_types.h"
#include "engine/occluder/shape_nodes.h"
#include "engine/occluder/solid.h"

#include <memory>
#include <string>
#include <vector>

namespace anvil {

/// Where an occluder is at a time of the edit, in [0, 1].
struct TimedPose {
    double at = 0;
    Placement place;
};

/// Flat arrays as the kernels read them, lengths relative to a local origin; `exact` and `sizes` have one
/// entry per occluder.
struct OccluderSet {
    std::vector<kernel::f64::Occluder> occluders;
    std::vector<kernel::f64::ShapeNode> nodes;
    std::vector<kernel::f64::ShapeSegment> segments; ///< influence curves
    std::vector<std::shared_ptr<const DistanceVolume>> volumes;
    std::shared_ptr<const std::vector<uint32_t>> field_words; ///< of all adaptive fields; empty: none
    std::vector<std::shared_ptr<const ExactDistance>> exact;
    std::vector<double> sizes; ///< diagonal of the occluder's bounds, of the mesh's if it is unbounded
    bool paper = false;        ///< all act by the paper's literal influence
    /// Poses by ascending time of the occluders that move; empty or shorter where they stand still.
    /// `occluders` holds the poses at the start. See occluder_motion.h.
    std::vector<std::vector<TimedPose>> motions;

    bool empty() const { return occluders.empty(); }
    bool moves() const { return !motions.empty(); }
    const uint32_t* words() const { return field_words ? field_words->data() : nullptr; }
};

/// What of an occluder does not depend on pose or influence: built once a recipe, baked where the recipe says
/// so.
struct OccluderModel {
    std::vector<kernel::f64::ShapeNode> nodes; ///< what the kernels evaluate; volume leaves count from 0
    std::vector<std::shared_ptr<const DistanceVolume>> volumes;
    std::shared_ptr<const AdaptiveField> field; ///< empty unless baked adaptively
    std::shared_ptr<const ExactDistance> exact;
    Box bounds; ///< in the occluder's space; infinite for unbounded shapes
};

/// What is baked comes from the cache where it has it. With an exact field, a shape without a formula has no
/// nodes: good for exact distances alone. With a device, if there is one, fields of meshes are baked there.
/// @throws InputError if a baked shape is unbounded, a shape encloses nothing (told by its bounds, when baked
/// by its surface too), the Boolean tree is too deep for the kernels, or a mesh file cannot be read;
/// DeviceError.
OccluderModel build_model(const OccluderShape& shape, const Field& field, Progress& progress,
                          const SolidSource& source = {}, const FileCache* cache = nullptr,
                          SearchDevice* device = nullptr);

/// A model baked from any bounded solid with a true distance; `field` is dense or adaptive.
/// @throws InputError if the solid is unbounded or has no extent; Cancelled; DeviceError.
OccluderModel sampled_model(std::shared_ptr<const ExactDistance> solid, const Field& field,
                            Progress& progress, const BakeCache& cache = {}, SearchDevice* device = nullptr);

/// What the occluders' defaults refer to.
struct OccluderScale {
    Vec3 origin;     ///< local origin, world
    double diagonal; ///< of the mesh's bounds
    double radius;   ///< of influence of the edit, R: sigma of a plane
};

/// Adds an occluder with its pose (world) and influence. @throws InputError if it needs more densely sampled
/// fields than an edit can hold.
void add_occluder(OccluderSet& set, const OccluderModel& model, const std::string& name,
                  const Transform& pose, const Influence& influence, const OccluderScale& scale);

/// Gives an occluder its box, bounds in its own space; sides at infinity are never left behind.
void set_box(kernel::f64::Occluder& occluder, const Box& bounds);

/// How deep inside a point still counts as touching from outside: 1e-9 of the occluder's size, more than
/// rounding makes of a point put on its surface.
double touching_distance(const OccluderSet& set, size_t occluder);

/// Exact signed distance of the nearest occluder at p (relative to the local origin); +inf without occluders.
SignedDistance exact_distance(const OccluderSet& set, const Vec3& p);

/// Exact signed distance of one occluder at p (relative to the local origin).
SignedDistance exact_distance(const OccluderSet& set, size_t occluder, const Vec3& p);

} // namespace anvil

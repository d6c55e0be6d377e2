// Points with displacements of their own, and an occluder: scenes in which contact can be measured.
#pragma once

#include "engine/deform/backend.h"
#include "engine/deform/contact_finish.h"
#include "engine/edit/recipe.h"

#include <memory>
#include <random>
#include <vector>

namespace anvil::test {

/// An occluder by its parts, as a recipe would give it.
struct SceneOccluder {
    OccluderShape shape;
    Field field{};
    Transform pose{};
    Influence influence{InfluenceKind::hard, 0.9, {}, {}, 0};
    std::shared_ptr<const OccluderModel> model{}; ///< of shape and field where scenes share it, else empty
};

/// Each point has a displacement of its own: six handles along +-x, +-y, +-z whose weights are the
/// components.
struct Scene {
    std::vector<Vec3> points;
    std::vector<Vec3> displacements;
    std::vector<SceneOccluder> occluders;
    double mesh_diagonal = 2;
    double radius = 1;
    bool fixed_steps = false;
    bool every_step = false; ///< fixed steps: none is left out
    uint32_t steps = 4096;
    double step_scale = 1; ///< multiplies h (margin and step) of every occluder
};

struct SceneResult {
    std::vector<Vec3> ends;
    std::vector<PointResult> results;
    std::vector<bool> inside;
    DeformInput input;
    size_t finished = 0;
};

OccluderSet occluder_set(const Scene& scene);
DeformInput scene_input(const Scene& scene, const OccluderSet& occluders);
DeformMotion scene_motion(const Scene& scene);
/// Runs the scene on a back end, with these occluders in place of its own; `finish` adds the exact CPU
/// finish.
SceneResult run_scene(const Scene& scene, const OccluderSet& occluders, Backend& backend, bool finish);
SceneResult run_scene(const Scene& scene, Backend& backend, bool finish);

inline Vec3 random_in(std::mt19937& random, const Vec3& low, const Vec3& high) {
    std::uniform_real_distribution<double> unit(0, 1);
    const double x = unit(random);
    const double y = unit(random);
    const double z = unit(random);
    return low + (high - low) * Vec3(x, y, z);
}

inline Vec3 random_direction(std::mt19937& random) {
    std::normal_distribution<double> normal;
    Vec3 v(normal(random), normal(random), normal(random));
    return v / glm::length(v);
}

} // namespace anvil::test

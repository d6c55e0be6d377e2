#include "tests/support/contact_scene.h"

#include <algorithm>

namespace anvil::test {

OccluderSet occluder_set(const Scene& scene) {
    OccluderSet set;
    Progress progress;
    for (const SceneOccluder& o : scene.occluders) {
        add_occluder(set, o.model ? *o.model : build_model(o.shape, o.field, progress), "occluder", o.pose,
                     o.influence, {Vec3(0), scene.mesh_diagonal, scene.radius});
    }
    for (auto& occluder : set.occluders) {
        occluder.margin *= scene.step_scale;
        occluder.step *= scene.step_scale;
    }
    return set;
}

namespace {

double largest_component(const Scene& scene) {
    double largest = 0;
    for (const Vec3& d : scene.displacements) {
        largest = std::max({largest, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    }
    return largest > 0 ? largest : 1;
}

} // namespace

DeformInput scene_input(const Scene& scene, const OccluderSet& occluders) {
    const size_t n = scene.points.size();
    DeformInput input;
    input.points = scene.points;
    input.handle_count = 6;
    input.fields.resize(6 * n);
    input.segments = {{0, 1, -1, 0, 0}}; // phi(t) = 1 - t
    input.shapes.assign(6, {0, 1});
    const double largest = largest_component(scene);
    for (size_t i = 0; i < n; ++i) {
        for (size_t j = 0; j < 6; ++j) {
            const double along = scene.displacements[i][static_cast<int>(j / 2)] / largest;
            input.fields[j * n + i] = 1 - std::max(0.0, j % 2 == 0 ? along : -along);
        }
    }
    input.occluders = occluders;
    find_start_distances(input);
    return input;
}

DeformMotion scene_motion(const Scene& scene) {
    DeformMotion motion;
    const double s = largest_component(scene);
    motion.targets = {Vec3(s, 0, 0),  Vec3(-s, 0, 0), Vec3(0, s, 0),
                      Vec3(0, -s, 0), Vec3(0, 0, s),  Vec3(0, 0, -s)};
    motion.fixed_steps = scene.fixed_steps;
    motion.every_step = scene.every_step;
    motion.steps = scene.steps;
    return motion;
}

SceneResult run_scene(const Scene& scene, Backend& backend, bool finish) {
    return run_scene(scene, occluder_set(scene), backend, finish);
}

SceneResult run_scene(const Scene& scene, const OccluderSet& occluders, Backend& backend, bool finish) {
    SceneResult out;
    out.input = scene_input(scene, occluders);
    const auto session = backend.prepare(out.input);
    session->update(scene_motion(scene));
    out.results = session->download();
    out.ends = scene.points;
    out.inside.resize(scene.points.size());
    for (size_t i = 0; i < out.ends.size(); ++i) {
        out.ends[i] += out.results[i].displacement;
        out.inside[i] = (out.results[i].flags & kernel::f64::VERTEX_STARTED_INSIDE) != 0;
    }
    if (finish) {
        out.finished = finish_contact(out.input.occluders, scene.points, out.inside, out.ends);
    }
    return out;
}

} // namespace anvil::test

// The kernels: blending alone, and forging past occluders.
#include "app/bench/deform_scene.h"
#include "app/bench/step_error.h"
#include "app/bench/workshop.h"

namespace anvil {

namespace {

std::function<void()> updates(Backend& backend, const DeformScene& scene) {
    const std::shared_ptr<DeformSession> session = backend.prepare(scene.input);
    return [session, motion = scene.motion] {
        session->update(motion);
        session->wait();
    };
}

std::vector<Yardstick> yardsticks_of(Workshop& workshop, const DeformScene& scene) {
    std::vector<Yardstick> yardsticks;
    yardsticks.push_back({"cpu", updates(workshop.cpu(), scene)});
    if (scene.input->fans.empty()) {
        yardsticks.push_back({"cpu_float", updates(workshop.float_cpu(), scene)});
    }
    if (scene.motion.fixed_steps) {
        DeformScene every = scene;
        every.motion.every_step = true;
        yardsticks.push_back({"cpu_float_all_steps", updates(workshop.float_cpu(), every)});
    }
    yardsticks.push_back(memcpy_yardstick(state_bytes(scene)));
    return yardsticks;
}

ReadyCase ready_case(Workshop& workshop, size_t vertices, const DeformSceneOptions& options) {
    const std::shared_ptr<const Mesh> sphere = workshop.sphere(vertices);
    const DeformScene scene = make_deform_scene(*sphere, options);
    ReadyCase ready;
    ready.vertices = sphere->vertex_count();
    ready.region = scene.input->points.size();
    ready.bytes = state_bytes(scene);
    ready.work = updates(workshop.tested(), scene);
    ready.yardsticks = yardsticks_of(workshop, scene);
    if (options.occluder != nullptr && options.fixed_steps == 0) {
        ready.error = step_error(workshop.tested(), workshop.cpu(), scene, bounds(*sphere).diagonal());
    }
    return ready;
}

class DeformCases {
  public:
    DeformCases(std::vector<BenchCase>& cases, Workshop& workshop) : cases_(cases), workshop_(workshop) {}

    void blend(size_t vertices) {
        for (const size_t handles : {1, 4, 16}) {
            DeformSceneOptions options;
            options.handles = handles;
            add("blend/k" + std::to_string(handles), vertices, options);
        }
    }

    /// fixed_steps 0: adaptive.
    void forge(size_t vertices, Workshop::Obstacle obstacle, uint32_t fixed_steps) {
        const char* name = obstacle == Workshop::Obstacle::analytic ? "forge/analytic/"
                           : obstacle == Workshop::Obstacle::dense  ? "forge/dense/"
                                                                    : "forge/adaptive-field/";
        add(name + steps_text(fixed_steps), vertices, {.fixed_steps = fixed_steps}, obstacle);
    }

    void region(size_t vertices, const char* share_text, double share) {
        const std::string name = std::string("region/") + share_text + "%/n32";
        const auto prepare = [&workshop = workshop_, vertices, share] {
            DeformSceneOptions options{.share = share, .fixed_steps = 32};
            options.occluder = &workshop.obstacle(Workshop::Obstacle::analytic);
            ReadyCase ready = ready_case(workshop, vertices, options);
            options.share = 1;
            ready.yardsticks.push_back({"whole_mesh", ready_case(workshop, vertices, options).work});
            return ready;
        };
        cases_.push_back({name + "/" + size_text(vertices), prepare});
    }

    /// With every step taken, so that a vertex costs the same wherever it is; beside the whole mesh alone.
    void region_of_equal_work(size_t vertices, const char* share_text, double share) {
        const auto prepare = [&workshop = workshop_, vertices, share] {
            const auto scene_of = [&](double part) {
                DeformSceneOptions options{.share = part, .fixed_steps = 32};
                options.occluder = &workshop.obstacle(Workshop::Obstacle::analytic);
                DeformScene scene = make_deform_scene(*workshop.sphere(vertices), options);
                scene.motion.every_step = true;
                return scene;
            };
            const DeformScene scene = scene_of(share);
            ReadyCase ready;
            ready.vertices = workshop.sphere(vertices)->vertex_count();
            ready.region = scene.input->points.size();
            ready.bytes = state_bytes(scene);
            ready.work = updates(workshop.tested(), scene);
            ready.yardsticks.push_back({"whole_mesh", updates(workshop.tested(), scene_of(1))});
            return ready;
        };
        cases_.push_back(
            {std::string("region/") + share_text + "%/n32-every/" + size_text(vertices), prepare});
    }

    /// Beside the order that regions have.
    void order(size_t vertices, PointOrder order) {
        const std::string name =
            order == PointOrder::shuffled ? "order/shuffled/n32/" : "order/as-given/n32/";
        const auto prepare = [&workshop = workshop_, vertices, order] {
            DeformSceneOptions options{.share = 0.2, .fixed_steps = 32, .order = order};
            options.occluder = &workshop.obstacle(Workshop::Obstacle::analytic);
            ReadyCase ready = ready_case(workshop, vertices, options);
            options.order = PointOrder::by_place;
            ready.yardsticks.push_back({"by_place", ready_case(workshop, vertices, options).work});
            return ready;
        };
        cases_.push_back({name + size_text(vertices), prepare});
    }

    /// Of all vertices, which a blend of one handle has moved; beside the blend alone.
    void normals(size_t vertices) {
        const auto prepare = [&workshop = workshop_, vertices] {
            ReadyCase ready = ready_case(workshop, vertices, {.normals = true});
            ready.yardsticks.push_back({"without_normals", ready_case(workshop, vertices, {}).work});
            return ready;
        };
        cases_.push_back({"normals/" + size_text(vertices), prepare});
    }

    void rotation(size_t vertices) {
        add("rotation/arc", vertices, {.kind = MotionKind::arc}, Workshop::Obstacle::analytic);
    }

  private:
    static std::string steps_text(uint32_t fixed_steps) {
        return fixed_steps == 0 ? "adaptive-steps" : "n" + std::to_string(fixed_steps);
    }

    void add(const std::string& name, size_t vertices, const DeformSceneOptions& options,
             std::optional<Workshop::Obstacle> obstacle = {}) {
        const auto prepare = [&workshop = workshop_, vertices, options, obstacle] {
            DeformSceneOptions with = options;
            with.occluder = obstacle ? &workshop.obstacle(*obstacle) : nullptr;
            return ready_case(workshop, vertices, with);
        };
        cases_.push_back({name + "/" + size_text(vertices), prepare});
    }

    std::vector<BenchCase>& cases_;
    Workshop& workshop_;
};

void add_quick_cases(DeformCases& cases) {
    using enum Workshop::Obstacle;
    constexpr size_t vertices = 100'000;
    cases.blend(vertices);
    for (const auto obstacle : {analytic, dense, adaptive_field}) {
        cases.forge(vertices, obstacle, 32);
        cases.forge(vertices, obstacle, 0);
    }
    cases.forge(vertices, analytic, 128);
    cases.region(vertices, "2.5", 0.025);
    cases.order(vertices, PointOrder::shuffled);
    cases.rotation(vertices);
    cases.normals(vertices);
}

} // namespace

void add_deform_cases(std::vector<BenchCase>& cases, Workshop& workshop, const BenchExtent& extent) {
    using enum Workshop::Obstacle;
    DeformCases adder(cases, workshop);
    if (extent.quick) {
        add_quick_cases(adder);
        return;
    }
    for (const size_t vertices : extent.sizes()) {
        adder.blend(vertices);
        for (const auto obstacle : {analytic, dense, adaptive_field}) {
            for (const uint32_t fixed_steps : {8U, 32U, 128U, 0U}) {
                adder.forge(vertices, obstacle, fixed_steps);
            }
        }
        adder.region(vertices, "1", 0.01);
        adder.region(vertices, "2.5", 0.025);
        adder.region_of_equal_work(vertices, "2.5", 0.025);
        adder.region(vertices, "20", 0.2);
        adder.region(vertices, "100", 1);
        adder.order(vertices, PointOrder::as_given);
        adder.order(vertices, PointOrder::shuffled);
        adder.rotation(vertices);
        adder.normals(vertices);
    }
}

} // namespace anvil

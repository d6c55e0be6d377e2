#include "engine/occluder/shape_nodes.h"
#include "tests/support/contact_scene.h"

#include <catch2/catch.hpp>

using namespace anvil;
using namespace anvil::test;

namespace {

const Influence hard{InfluenceKind::hard, 0.9, {}, {}, 0};
const Influence soft{InfluenceKind::soft, 0.9, 0.05, {}, 0};

double deepest(const SceneResult& result) {
    double depth = 0;
    for (size_t i = 0; i < result.ends.size(); ++i) {
        if (!result.inside[i]) {
            depth = std::max(depth, -exact_distance(result.input.occluders, result.ends[i]).distance);
        }
    }
    return depth;
}

/// Points above a horizontal plate pushed down through it, beginning far away or within a voxel of it.
Scene plate_scene(double thickness, const Field& field, bool from_the_band, double band) {
    Scene scene;
    scene.occluders = {{BoxShape{{0.8, 0.5 * thickness, 0.8}, 0}, field, {}, hard}};
    std::mt19937 random(11);
    for (int i = 0; i < 1500; ++i) {
        const double u = random_in(random, Vec3(0), Vec3(1)).x;
        const double y = from_the_band ? 0.5 * thickness + u * band : 0.3 + 0.2 * u;
        scene.points.push_back(random_in(random, {-0.6, y, -0.6}, {0.6, y, 0.6}));
        scene.displacements.push_back(random_in(random, {-0.1, -0.8, -0.1}, {0.1, -0.8, 0.1}));
    }
    return scene;
}

struct NamedShape {
    const char* name;
    OccluderShape shape;
};

std::vector<NamedShape> bounded_shapes() {
    const CsgShape csg{CsgOperation::subtract,
                       {{"", BoxShape{Vec3(0.5), 0.05}, {}}, {"", CylinderShape{0.25, 2}, {}}}};
    return {{"sphere", SphereShape{0.5}},
            {"box", BoxShape{{0.5, 0.3, 0.4}, 0}},
            {"rounded box", BoxShape{Vec3(0.45), 0.1}},
            {"cylinder", CylinderShape{0.4, 0.8}},
            {"capsule", CapsuleShape{0.25, 0.6}},
            {"cone", ConeShape{0.5, 0.9}},
            {"torus", TorusShape{0.45, 0.15}},
            {"drilled box", csg}};
}

/// Points around an occluder of about unit size, thrown at it from all sides, `reach` occluder sizes far.
Scene attack(const NamedShape& shape, const Influence& influence, double reach, size_t count) {
    Scene scene;
    scene.occluders = {{shape.shape, {}, {}, influence}};
    std::mt19937 random(12);
    const auto exact = formula_distance(shape_nodes(shape.shape));
    while (scene.points.size() < count) {
        const Vec3 p = random_in(random, Vec3(-1.2), Vec3(1.2));
        if (exact->at(p).distance >= 0) {
            const Vec3 aim = random_in(random, Vec3(-0.4), Vec3(0.4)) - p;
            scene.points.push_back(p);
            scene.displacements.push_back(aim * (reach / glm::length(aim)));
        }
    }
    return scene;
}

void check_that_none_entered(const Scene& scene, Backend& backend) {
    const SceneResult result = run_scene(scene, backend, true);
    CHECK(deepest(result) <= 1e-6 * result.input.occluders.sizes[0]);
    for (const PointResult& r : result.results) {
        REQUIRE(is_finite(r.displacement));
    }
}

} // namespace

TEST_CASE("nothing passes a thin plate, baked or exact, from afar or from its surface") {
    const auto cpu = make_cpu_backend();
    for (const Field& field : {Field{FieldKind::dense, 64}, Field{FieldKind::dense, 128},
                               Field{FieldKind::adaptive, 64}, Field{FieldKind::adaptive, 128}}) {
        const double voxel = 1.6 / (field.resolution - 7);
        for (double thickness : {0.25, 1.0, 3.0}) {
            for (bool band : {false, true}) {
                const Scene scene = plate_scene(thickness * voxel, field, band, voxel);
                const SceneResult result = run_scene(scene, *cpu, true);
                INFO("voxels " << thickness << " at " << field.resolution
                               << (field.kind == FieldKind::dense ? " dense" : " adaptive")
                               << (band ? " from the band" : " from afar"));
                for (const Vec3& end : result.ends) {
                    REQUIRE(end.y >= 0.5 * thickness * voxel - 1e-6);
                }
            }
        }
    }
    for (bool band : {false, true}) {
        const SceneResult result = run_scene(plate_scene(1e-3, {}, band, 0.02), *cpu, false);
        for (const Vec3& end : result.ends) {
            REQUIRE(end.y >= 0.5e-3 - 1e-12);
        }
    }
}

TEST_CASE("no vertex that started outside ends inside any shape by formula, hard or soft, from ten sizes") {
    const auto cpu = make_cpu_backend();
    for (const NamedShape& shape : bounded_shapes()) {
        for (const Influence& influence : {hard, soft}) {
            for (double reach : {1.0, 10.0}) {
                INFO(shape.name << ", reach " << reach);
                check_that_none_entered(attack(shape, influence, reach, 250), *cpu);
            }
        }
    }
}

TEST_CASE("no vertex that started outside ends inside any baked shape, hard or soft, from ten sizes") {
    const auto cpu = make_cpu_backend();
    Progress progress;
    for (const NamedShape& shape : bounded_shapes()) {
        for (uint32_t resolution : {64U, 128U}) {
            if (resolution == 128 && std::holds_alternative<CsgShape>(shape.shape.solid)) {
                continue; // seconds of closest points, and nothing that 64 voxels do not show
            }
            const Field field{FieldKind::dense, resolution};
            const auto model =
                std::make_shared<const OccluderModel>(build_model(shape.shape, field, progress));
            for (double reach : {1.0, 10.0}) {
                for (const Influence& influence : {hard, soft}) {
                    INFO(shape.name << " at " << resolution << " voxels, reach " << reach);
                    Scene scene = attack(shape, influence, reach, 120);
                    scene.occluders[0].model = model;
                    check_that_none_entered(scene, *cpu);
                }
            }
        }
    }
}

TEST_CASE("a vertex ends no farther from its start than its displacement is long, however short that is") {
    const auto cpu = make_cpu_backend();
    const double h = std::sqrt(3.0) / 128;
    for (const Field& field : {Field{}, Field{FieldKind::dense, 64}}) {
        for (double size : {1e-12, 1e-9, 1e-6, 0.1 * h, 0.5 * h, 2 * h, 20 * h}) {
            Scene scene;
            scene.occluders = {{SphereShape{0.5}, field, {}, hard}};
            std::mt19937 random(13);
            for (int i = 0; i < 2000; ++i) {
                const double height = random_in(random, Vec3(0), Vec3(4 * h)).x;
                scene.points.push_back((0.5 + height) * random_direction(random));
                scene.displacements.push_back(size * random_direction(random));
            }
            const SceneResult result = run_scene(scene, *cpu, false);
            for (const PointResult& r : result.results) {
                REQUIRE(glm::length(r.displacement) <= size * (1 + 1e-9) + 1e-16);
            }
        }
    }
}

TEST_CASE("a short push against a sphere ends where projecting on it ends") {
    const double h = std::sqrt(3.0) / 128;
    Scene scene;
    scene.occluders = {{SphereShape{0.5}, {}, {}, hard}};
    std::mt19937 random(14);
    for (int i = 0; i < 2000; ++i) {
        scene.points.push_back((0.5 + random_in(random, Vec3(0), Vec3(3 * h)).x) * random_direction(random));
        scene.displacements.push_back(2 * h * random_direction(random));
    }
    const SceneResult result = run_scene(scene, *make_cpu_backend(), false);
    for (size_t i = 0; i < scene.points.size(); ++i) {
        const Vec3 q = scene.points[i] + scene.displacements[i];
        const Vec3 truth = glm::length(q) < 0.5 ? 0.5 / glm::length(q) * q : q;
        // Projecting once against sliding: they part by |d|^2 / 2r, here 0.054 h, and less from each step.
        CHECK(glm::length(result.ends[i] - truth) < 0.1 * h);
    }
}

TEST_CASE("a vertex whose own displacement is zero is not moved by an occluder, inside or out") {
    Scene scene;
    scene.occluders = {{SphereShape{0.5}, {FieldKind::dense, 64}, {}, {}}};
    std::mt19937 random(15);
    for (int i = 0; i < 500; ++i) {
        scene.points.push_back(random_in(random, Vec3(-0.6), Vec3(0.6)));
        scene.displacements.push_back(Vec3(0));
    }
    for (const PointResult& r : run_scene(scene, *make_cpu_backend(), true).results) {
        CHECK(r.displacement == Vec3(0));
    }
}

TEST_CASE("halving the step halves the change: contact on an analytic shape converges") {
    const auto cpu = make_cpu_backend();
    for (const OccluderShape& shape : {OccluderShape{SphereShape{0.5}}, OccluderShape{TorusShape{0.5, 0.2}},
                                       OccluderShape{CapsuleShape{0.3, 0.5}}}) {
        std::vector<Vec3> previous;
        std::vector<double> changes;
        for (int k = 0; k < 6; ++k) {
            Scene scene;
            scene.occluders = {{shape, {}, {{0.05, 0, 0}, {1, 0, 1}, 20, 1}, hard}};
            scene.step_scale = 2 * std::pow(0.5, k);
            std::mt19937 random(16);
            for (int i = 0; i < 2000; ++i) {
                scene.points.push_back(random_in(random, {-0.45, 0.9, -0.45}, {0.45, 0.9, 0.45}));
                scene.displacements.push_back({0.2, -1, 0.1});
            }
            const SceneResult result = run_scene(scene, *cpu, false);
            if (!previous.empty()) {
                // Points that meet a ridge or the hole's rim head on may pass on either side: leave those
                // out.
                std::vector<double> squares;
                for (size_t i = 0; i < previous.size(); ++i) {
                    const Vec3 change = result.ends[i] - previous[i];
                    squares.push_back(glm::dot(change, change));
                }
                std::sort(squares.begin(), squares.end());
                double sum = 0;
                for (size_t i = 0; i < squares.size() * 98 / 100; ++i) {
                    sum += squares[i];
                }
                changes.push_back(std::sqrt(sum / static_cast<double>(squares.size())));
            }
            previous = result.ends;
        }
        const double slope =
            std::log2(changes.front() / changes.back()) / static_cast<double>(changes.size() - 1);
        CHECK(changes.size() == 5);
        CHECK(slope >= 0.9);
    }
}

TEST_CASE("a wedge of two planes is not entered, whatever its angle") {
    for (double degrees : {5.0, 20.0, 45.0, 70.0}) {
        const double a = glm::radians(degrees);
        Scene scene;
        scene.occluders = {{PlaneShape{{std::cos(a), std::sin(a), 0}, 0}, {}, {}, hard},
                           {PlaneShape{{-std::cos(a), std::sin(a), 0}, 0}, {}, {}, hard}};
        std::mt19937 random(17);
        for (int i = 0; i < 500; ++i) {
            scene.points.push_back(random_in(random, {-0.02, 1, -0.5}, {0.02, 1, 0.5}));
            scene.displacements.push_back({0.05, -2, 0});
        }
        const SceneResult result = run_scene(scene, *make_cpu_backend(), true);
        INFO("half angle " << degrees);
        CHECK(deepest(result) <= 2e-9);
        for (const Vec3& end : result.ends) {
            CHECK(end.y < 0.3); // they do go down
        }
    }
}

TEST_CASE("two touching spheres are flowed around, and what rests between them stays outside") {
    for (const Field& field : {Field{}, Field{FieldKind::dense, 64}}) {
        Scene scene;
        scene.occluders = {{SphereShape{0.5}, field, {{-0.5, 0, 0}}, hard},
                           {SphereShape{0.5}, field, {{0.5, 0, 0}}, hard}};
        std::mt19937 random(18);
        for (int i = 0; i < 800; ++i) {
            scene.points.push_back(random_in(random, {-0.9, 0.8, -0.4}, {0.9, 0.8, 0.4}));
            scene.displacements.push_back(random_in(random, {-0.1, -1.6, -0.1}, {0.1, -1.6, 0.1}));
        }
        const SceneResult result = run_scene(scene, *make_cpu_backend(), true);
        CHECK(deepest(result) <= 1e-6);
    }
}

TEST_CASE("an occluder beyond another one's margin is still met, however small it is") {
    Scene scene; // a vertex held on a large plane's wide margin slides over a pebble
    scene.mesh_diagonal = 20;
    scene.occluders = {{PlaneShape{{0, 1, 0}, 0}, {}, {}, hard},
                       {SphereShape{0.02}, {}, {{0, 0.02, 0}}, hard}};
    for (int i = 0; i < 100; ++i) {
        scene.points.push_back({-1, 1e-3 + 3e-4 * i, 0.0004 * (i % 10)});
        scene.displacements.push_back({2, -0.5, 0});
    }
    const SceneResult result = run_scene(scene, *make_cpu_backend(), true);
    CHECK(deepest(result) <= 1e-8);
}

TEST_CASE("what starts inside is moved out no faster than it moves itself") {
    Scene scene;
    scene.occluders = {{SphereShape{0.5}, {}, {}, hard}};
    std::mt19937 random(19);
    for (int i = 0; i < 500; ++i) {
        scene.points.push_back(random_in(random, Vec3(-0.25), Vec3(0.25)));
        scene.displacements.push_back(0.05 * random_direction(random));
    }
    const SceneResult result = run_scene(scene, *make_cpu_backend(), true);
    for (size_t i = 0; i < scene.points.size(); ++i) {
        CHECK(result.inside[i]);
        CHECK(glm::length(result.results[i].displacement) <= 2 * 0.05 * (1 + 1e-9));
        CHECK(glm::length(result.ends[i]) >= glm::length(scene.points[i]) - 1e-12);
    }
}

TEST_CASE(
    "what starts inside is pushed by its own step to the last hair, and held only once that is enough") {
    Scene scene;
    scene.occluders = {{PlaneShape{{0, 1, 0}, 0}, {}, {}, hard}};
    scene.fixed_steps = true;
    scene.steps = 1;
    const double depth = 0.05;
    std::vector<double> missing;
    for (double hair = 1e-9; hair < 1e-3; hair *= 3) {
        for (const double more : {-hair, hair}) {
            missing.push_back(std::max(0.0, -more));
            scene.points.push_back({0, -depth, 0});
            scene.displacements.push_back({depth + more, 0, 0});
        }
    }
    const SceneResult result = run_scene(scene, *make_cpu_backend(), false);
    for (size_t i = 0; i < missing.size(); ++i) {
        INFO(missing[i]);
        CHECK(result.ends[i].y == Approx(-missing[i]).margin(1e-15));
    }
}

TEST_CASE("what starts inside a small occluder is moved out gradually, near a wide margin of another too") {
    Scene scene; // the plane's margin is 20 / 128: all points lie in its band, some inside the ball
    scene.mesh_diagonal = 20;
    scene.occluders = {{PlaneShape{{0, 1, 0}, 0}, {}, {}, hard},
                       {SphereShape{0.05}, {}, {{0, 0.06, 0}}, hard}};
    std::mt19937 random(23);
    for (int i = 0; i < 300; ++i) {
        scene.points.push_back(Vec3(0, 0.06, 0) + 0.048 * random_direction(random));
        scene.displacements.push_back(0.001 * random_direction(random));
    }
    const SceneResult result = run_scene(scene, *make_cpu_backend(), true);
    for (size_t i = 0; i < scene.points.size(); ++i) {
        CHECK(result.inside[i]);
        CHECK(glm::length(result.ends[i] - scene.points[i]) <= 2 * 0.001 * (1 + 1e-9));
    }
}

TEST_CASE("the step limit stops a vertex outside and says so") {
    Scene scene;
    scene.steps = 20;
    scene.occluders = {{PlaneShape{{0, 1, 0}, 0}, {}, {}, hard}};
    scene.points = {{0, 0.001, 0}, {0, 5, 0}};
    scene.displacements = {{5, -0.5, 0}, {5, 0, 0}};
    const SceneResult result = run_scene(scene, *make_cpu_backend(), false);
    CHECK((result.results[0].flags & kernel::f64::VERTEX_LIMIT_REACHED) != 0);
    CHECK(result.ends[0].y >= -1e-15);
    CHECK(result.ends[0].x < 1);
    CHECK((result.results[1].flags & kernel::f64::VERTEX_LIMIT_REACHED) == 0);
    CHECK(result.ends[1] == scene.points[1] + scene.displacements[1]);
}

TEST_CASE("fixed steps that skip far from the occluder end where all steps end") {
    Scene scene;
    scene.fixed_steps = true;
    scene.steps = 400;
    scene.occluders = {{SphereShape{0.5}, {}, {}, {InfluenceKind::soft, 0.9, 0.05, {}, 0}}};
    std::mt19937 random(20);
    for (int i = 0; i < 500; ++i) {
        scene.points.push_back(random_in(random, {-0.6, 1.5, -0.6}, {0.6, 2, 0.6}));
        scene.displacements.push_back({0.1, -2.2, 0});
    }
    const SceneResult skipping = run_scene(scene, *make_cpu_backend(), false);
    // A second occluder far away along the whole path, whose influence reaches everywhere, forbids skipping.
    scene.occluders.push_back({SphereShape{0.5}, {}, {{50, 0, 0}}, {InfluenceKind::soft, 0, 1e3, {}, 0}});
    const SceneResult stepping = run_scene(scene, *make_cpu_backend(), false);
    for (size_t i = 0; i < scene.points.size(); ++i) {
        CHECK(stepping.results[i].steps == 400);
        CHECK(skipping.results[i].steps < 400);
        CHECK(glm::length(skipping.ends[i] - stepping.ends[i]) < 1e-6);
    }
}

TEST_CASE("the paper's influence is eq. 11 to 17 to the letter") {
    Scene scene;
    scene.fixed_steps = true;
    scene.steps = 32;
    scene.occluders = {{SphereShape{0.5}, {}, {{0.1, 0, 0}}, {InfluenceKind::paper, 0.9, {}, {}, 0}}};
    std::mt19937 random(21);
    for (int i = 0; i < 300; ++i) {
        scene.points.push_back(random_in(random, Vec3(-1), Vec3(1)));
        scene.displacements.push_back(random_in(random, Vec3(-1), Vec3(1)));
    }
    const SceneResult result = run_scene(scene, *make_cpu_backend(), false);
    for (size_t i = 0; i < scene.points.size(); ++i) {
        Vec3 p = scene.points[i];
        for (int step = 0; step < 32; ++step) {
            const Vec3 q = p + scene.displacements[i] / 32.0;
            const Vec3 arm = q - Vec3(0.1, 0, 0);
            const double delta = glm::length(arm) - 0.5;
            const Vec3 towards_surface = (delta < 0 ? 1.0 : -1.0) * arm / glm::length(arm);
            const double psi = delta <= 0 ? delta : std::exp(-delta * delta);
            p = q - psi * towards_surface;
        }
        CHECK(glm::length(result.ends[i] - p) < 1e-12);
    }
}

TEST_CASE("a user's own influence curve slows like the soft one that it imitates") {
    // The curve is a fine polyline of 0.9 exp(-(delta / sigma)^2) up to 4 sigma.
    const double sigma = 0.1;
    std::vector<Knot> knots;
    for (int i = 0; i <= 200; ++i) {
        const double x = 4.0 * i / 200;
        const double slope = 4 * -2 * x * 0.9 * std::exp(-x * x);
        knots.push_back({i / 200.0, i == 200 ? 0 : 0.9 * std::exp(-x * x), slope, slope});
    }
    Scene scene;
    std::mt19937 random(22);
    for (int i = 0; i < 300; ++i) {
        scene.points.push_back(random_in(random, {-0.4, 0.7, -0.4}, {0.4, 1.2, 0.4}));
        scene.displacements.push_back({0, -0.8, 0.1});
    }
    scene.occluders = {{SphereShape{0.5}, {}, {}, {InfluenceKind::soft, 0.9, sigma, {}, 0}}};
    const SceneResult gaussian = run_scene(scene, *make_cpu_backend(), false);
    scene.occluders = {{SphereShape{0.5}, {}, {}, {InfluenceKind::curve, 0.9, {}, knots, 4 * sigma}}};
    const SceneResult own = run_scene(scene, *make_cpu_backend(), false);
    for (size_t i = 0; i < scene.points.size(); ++i) {
        CHECK(glm::length(gaussian.ends[i] - own.ends[i]) <
              0.01); // both are first order in steps of sigma / 8
        CHECK(gaussian.ends[i].y > scene.points[i].y - 0.8);
    }
}

TEST_CASE("a pressed slab keeps half its thickness when hard and most of it when soft over two thicknesses") {
    // Thickness 1, pressed 0.5 beyond contact from 0.5 away: mathematics of the influence.
    const auto thickness_left = [](const Influence& influence) {
        Scene scene;
        scene.mesh_diagonal = 2;
        scene.occluders = {{PlaneShape{{0, 1, 0}, 0}, {}, {}, influence}};
        scene.points = {{0, 0.5, 0}, {0, 1.5, 0}};
        scene.displacements = {{0, -1, 0}, {0, -1, 0}};
        const SceneResult result = run_scene(scene, *make_cpu_backend(), true);
        return result.ends[1].y - result.ends[0].y;
    };
    CHECK(thickness_left(hard) == Approx(0.5).margin(0.01));
    CHECK(thickness_left({InfluenceKind::soft, 0.9, 2.0, {}, 0}) >= 0.70);
}

TEST_CASE("the CPU finish puts vertices on the nearest surface, and out of wedges") {
    Scene scene;
    scene.occluders = {{SphereShape{0.5}, {}, {}, hard}};
    const OccluderSet set = occluder_set(scene);
    const std::vector<Vec3> starts{{1, 0, 0}, {0, 1, 0}, {0, 0, 0.1}};
    std::vector<Vec3> ends{{0.3, 0, 0}, {0, 0.7, 0}, {0, 0, 0.2}};
    CHECK(finish_contact(set, starts, {false, false, true}, ends) == 1);
    CHECK(glm::length(ends[0] - Vec3(0.5, 0, 0)) < 1e-15);
    CHECK(ends[1] == Vec3(0, 0.7, 0));
    CHECK(ends[2] == Vec3(0, 0, 0.2));
}

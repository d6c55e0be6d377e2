#include "engine/deform/deform_input.h"
#include "engine/edit/rotation.h"
#include "engine/gpu/selftest.h"
#include "engine/occluder/distance_volume.h"
#include "engine/occluder/exact_distance.h"
#include "engine/occluder/occluder_motion.h"
#include "engine/occluder/occluder_set.h"

#include <random>

namespace anvil {

namespace {

namespace k = kernel::f64;

constexpr size_t point_count = 3001; // no multiple of any workgroup
constexpr double diagonal = 4;       // points in [-1, 1]^3, paths up to 1 long

/// Uniform numbers that are the same with every standard library.
class Random {
  public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    double between(double low, double high) { return low + (high - low) * engine_() / 4294967296.0; }
    Vec3 vector(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
    Vec3 direction() {
        for (;;) {
            const Vec3 v = vector(1);
            if (glm::length(v) > 0.1 && glm::length(v) < 1) {
                return glm::normalize(v);
            }
        }
    }

  private:
    std::mt19937 engine_;
};

/// phi, with its Lipschitz constant.
struct Curve {
    std::vector<k::ShapeSegment> segments;
    double lipschitz;
};

Curve smooth_curve() {
    return {{{0, 1, 0, -3, 2}}, 1.5};
}
Curve cone_curve() {
    return {{{0, 1, -1, 0, 0}}, 1};
}
/// Two bumps with kinks and a negative part.
Curve crater_curve() {
    return {{{0, -0.5, 0, 6, 0}, {0.5, 1, -3, 2, 0}}, 6};
}

void add_shape(SelftestCase& test, const Curve& curve) {
    test.input.shapes.push_back(
        {static_cast<uint32_t>(test.input.segments.size()), static_cast<uint32_t>(curve.segments.size())});
    test.input.segments.insert(test.input.segments.end(), curve.segments.begin(), curve.segments.end());
    test.lipschitz = std::max(test.lipschitz, curve.lipschitz);
}

/// `handles` handles at random points, Euclidean distances over random radii.
SelftestCase scene(std::string name, uint32_t seed, size_t handles, size_t points = point_count) {
    Random random(seed);
    SelftestCase test{
        .name = std::move(name), .input = {}, .motion = {}, .diagonal = diagonal, .lipschitz = 1};
    for (size_t i = 0; i < points; ++i) {
        test.input.points.push_back(random.vector(1));
    }
    test.input.handle_count = handles;
    const std::array curves{smooth_curve(), cone_curve(), crater_curve()};
    for (size_t j = 0; j < handles; ++j) {
        add_shape(test, curves[j % curves.size()]);
        const Vec3 handle = random.vector(0.8);
        const double radius = random.between(0.8, 2.5);
        for (const Vec3& p : test.input.points) {
            test.input.fields.push_back(glm::length(p - handle) / radius);
        }
        test.motion.targets.push_back(random.direction() * random.between(0.3, 1) /
                                      std::sqrt(static_cast<double>(handles)));
    }
    test.motion.path_epsilon = 1e-9;
    return test;
}

k::ShapeNode leaf(uint32_t kind, Vec3 size, double extra = 0) {
    return {kind, 0, 0, size, extra, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, Vec3(0), 1};
}

k::ShapeNode placed(k::ShapeNode node, Vec3 origin) {
    node.origin = origin;
    return node;
}

k::ShapeNode operation(uint32_t kind) {
    return leaf(kind, Vec3(0));
}

/// Adds an occluder in a random pose about the middle; `size`: of its diagonal, for the margin.
k::Occluder& add_occluder(SelftestCase& test, const std::vector<k::ShapeNode>& nodes, uint32_t seed,
                          uint32_t influence = k::INFLUENCE_SOFT) {
    Random random(seed);
    const Vec3 y = random.direction();
    const Vec3 x = glm::normalize(glm::cross(y, random.direction()));
    OccluderSet& set = test.input.occluders;
    k::Occluder occluder{};
    occluder.axis_x = x;
    occluder.axis_y = y;
    occluder.axis_z = glm::cross(x, y);
    occluder.origin = random.vector(0.4);
    occluder.scale = random.between(0.7, 1.3);
    occluder.first_node = static_cast<uint32_t>(set.nodes.size());
    occluder.node_count = static_cast<uint32_t>(nodes.size());
    occluder.margin = 1.0 / 128;
    occluder.step = occluder.margin / 2;
    occluder.influence = influence;
    occluder.strength = 0.9;
    occluder.width = influence == k::INFLUENCE_CURVE ? 0.2 : 0.05;
    set.nodes.insert(set.nodes.end(), nodes.begin(), nodes.end());
    set.occluders.push_back(occluder);
    set.exact.push_back(formula_distance(nodes));
    set.sizes.push_back(1);
    set_box(set.occluders.back(), set.exact.back()->bounds());
    return set.occluders.back();
}

SelftestCase finished(SelftestCase test) {
    find_start_distances(test.input);
    return test;
}

struct NamedShape {
    const char* name;
    std::vector<k::ShapeNode> nodes;
};

std::vector<NamedShape> shapes() {
    return {{"sphere", {leaf(k::SHAPE_SPHERE, {0.4, 0, 0})}},
            {"rounded box", {leaf(k::SHAPE_BOX, {0.4, 0.3, 0.2}, 0.05)}},
            {"cylinder", {leaf(k::SHAPE_CYLINDER, {0.3, 0.4, 0})}},
            {"capsule", {leaf(k::SHAPE_CAPSULE, {0.25, 0.3, 0})}},
            {"cone", {leaf(k::SHAPE_CONE, {0.4, 0.4, 0})}},
            {"torus", {leaf(k::SHAPE_TORUS, {0.4, 0.15, 0})}},
            {"plane", {leaf(k::SHAPE_PLANE, {0.6, 0.8, 0}, -0.1)}},
            {"union",
             {leaf(k::SHAPE_SPHERE, {0.3, 0, 0}), placed(leaf(k::SHAPE_SPHERE, {0.3, 0, 0}), {0.35, 0, 0}),
              operation(k::SHAPE_UNION)}},
            {"intersection",
             {leaf(k::SHAPE_SPHERE, {0.5, 0, 0}), leaf(k::SHAPE_BOX, {0.4, 0.2, 0.6}, 0.02),
              operation(k::SHAPE_INTERSECTION)}},
            {"subtraction",
             {leaf(k::SHAPE_BOX, {0.5, 0.3, 0.4}), leaf(k::SHAPE_SPHERE, {0.35, 0, 0}),
              operation(k::SHAPE_SUBTRACTION)}}};
}

void add_shape_cases(std::vector<SelftestCase>& cases) {
    uint32_t seed = 100;
    for (const auto& [name, nodes] : shapes()) {
        for (const auto& [kind, influence] :
             {std::pair{"hard", k::INFLUENCE_HARD}, std::pair{"soft", k::INFLUENCE_SOFT}}) {
            ++seed;
            SelftestCase test = scene(std::string(name) + ", " + kind, seed, 2);
            add_occluder(test, nodes, seed, influence);
            cases.push_back(finished(std::move(test)));
        }
    }
}

/// The field of a rounded box, sampled on a grid.
SelftestCase sampled_case(const char* name, uint32_t seed) {
    SelftestCase test = scene(name, seed, 2);
    auto volume = std::make_shared<DistanceVolume>();
    const auto exact = formula_distance({leaf(k::SHAPE_BOX, {0.4, 0.3, 0.25}, 0.1)});
    volume->voxel = 1.0 / 32;
    volume->size = {33, 29, 25};
    volume->half_size = 0.5 * volume->voxel * Vec3(32, 28, 24);
    for (uint32_t z = 0; z < volume->size[2]; ++z) {
        for (uint32_t y = 0; y < volume->size[1]; ++y) {
            for (uint32_t x = 0; x < volume->size[0]; ++x) {
                const SignedDistance d = exact->at(volume->voxel * Vec3(x, y, z) - volume->half_size);
                for (const double value : {d.normal.x, d.normal.y, d.normal.z, d.distance}) {
                    volume->texels.push_back(static_cast<float>(value));
                }
            }
        }
    }
    k::ShapeNode node = leaf(k::SHAPE_VOLUME, volume->half_size, volume->voxel);
    add_occluder(test, {leaf(k::SHAPE_SPHERE, {0.4, 0, 0})}, seed);
    k::Occluder& occluder = add_occluder(test, {node}, seed + 1, k::INFLUENCE_HARD);
    occluder.origin = {-0.7, 0.3, 0.1};
    occluder.margin = occluder.scale * volume->voxel;
    occluder.step = occluder.margin / 2;
    occluder.settle = 0.1 * occluder.margin;
    test.input.occluders.nodes.back().volume = 0;
    test.input.occluders.volumes.push_back(volume);
    test.input.occluders.exact.back() = exact;
    set_box(occluder, exact->bounds());
    return finished(std::move(test));
}

/// Two adaptive fields, so that one begins behind the other's words.
SelftestCase adaptive_case(const char* name, uint32_t seed) {
    SelftestCase test = scene(name, seed, 2);
    const std::array solids{formula_distance({leaf(k::SHAPE_BOX, {0.4, 0.3, 0.25}, 0.1)}),
                            formula_distance({leaf(k::SHAPE_TORUS, {0.35, 0.12, 0})})};
    for (const auto& solid : solids) {
        ++seed;
        Progress progress;
        const OccluderModel model = sampled_model(solid, {FieldKind::adaptive, 48}, progress);
        Random random(seed);
        Transform pose;
        pose.translate = random.vector(0.4);
        pose.axis = random.direction();
        pose.degrees = random.between(0, 360);
        pose.scale = random.between(0.7, 1.3);
        add_occluder(test.input.occluders, model, "adaptive", pose, {InfluenceKind::soft, 0.9, {}, {}, 0},
                     {Vec3(0), diagonal, 1});
    }
    return finished(std::move(test));
}

void add_motion_cases(std::vector<SelftestCase>& cases) {
    for (const auto& [name, kind] : {std::pair{"rotation along the arc", MotionKind::arc},
                                     std::pair{"rotation along the chord", MotionKind::chord}}) {
        SelftestCase test = scene(name, 300, 3);
        test.motion.kind = kind;
        test.motion.axis_origin = {0.1, -0.2, 0.3};
        test.motion.axis_direction = glm::normalize(Vec3(0.2, 1, -0.3));
        for (Vec3& target : test.motion.targets) {
            target = Vec3(target.x * 2, 0, 0);
        }
        add_occluder(test, {leaf(k::SHAPE_SPHERE, {0.3, 0, 0})}, 301);
        cases.push_back(finished(std::move(test)));
    }
    SelftestCase bent = scene("path with three samples", 310, 2);
    const std::vector<Vec3> end = bent.motion.targets;
    bent.motion.targets = {0.4 * end[0], 0.2 * end[1], 0.5 * end[0] + Vec3(0.1, 0, 0),
                           0.8 * end[1], end[0],       end[1]};
    add_occluder(bent, {leaf(k::SHAPE_CAPSULE, {0.2, 0.4, 0})}, 311);
    cases.push_back(finished(std::move(bent)));
}

/// The last occluder's way, from where it is: pushed, turned and blown up.
void add_hammer(SelftestCase& test, Vec3 by, double angle, double scale) {
    const k::Occluder& o = test.input.occluders.occluders.back();
    const Placement first{{o.axis_x, o.axis_y, o.axis_z}, o.origin, o.scale};
    Placement second = first;
    const Rotation turn(Vec3(0), Vec3(1, 2, -1));
    for (Vec3& axis : second.axes) {
        axis = turn.turned(axis, angle);
    }
    second.origin += by;
    Placement third = second;
    third.origin += Vec3(-by.y, by.x, 0.5 * by.z);
    third.scale *= scale;
    set_motion(test.input.occluders, {{0, first}, {0.6, second}, {1, third}});
    test.motion.times = {0.6, 1};
    const std::vector<Vec3> ends = test.motion.targets;
    test.motion.targets.clear();
    for (const double t : test.motion.times) {
        for (const Vec3& end : ends) {
            test.motion.targets.push_back(t * end);
        }
    }
}

void add_hammer_cases(std::vector<SelftestCase>& cases) {
    SelftestCase blow = scene("hammer, no handle", 350, 0);
    add_occluder(blow, {leaf(k::SHAPE_SPHERE, {0.35, 0, 0})}, 351, k::INFLUENCE_HARD);
    add_hammer(blow, {0.5, 0.2, -0.3}, 0, 1);
    cases.push_back(finished(std::move(blow)));

    SelftestCase paddle = scene("paddle against a moving mesh", 360, 2);
    add_occluder(paddle, {leaf(k::SHAPE_BOX, {0.5, 0.3, 0.1}, 0.05)}, 361, k::INFLUENCE_SOFT);
    add_hammer(paddle, {0, 0, 0}, 1.2, 1);
    cases.push_back(finished(std::move(paddle)));

    SelftestCase turned = scene("swelling hammer against a turning mesh", 370, 2);
    add_occluder(turned, {leaf(k::SHAPE_CAPSULE, {0.2, 0.3, 0})}, 371, k::INFLUENCE_SOFT);
    add_occluder(turned, {leaf(k::SHAPE_SPHERE, {0.25, 0, 0})}, 372, k::INFLUENCE_HARD);
    add_hammer(turned, {0.2, -0.3, 0.1}, -0.7, 1.4);
    turned.motion.kind = MotionKind::chord;
    turned.motion.axis_origin = {0.1, -0.2, 0.3};
    turned.motion.axis_direction = glm::normalize(Vec3(0.2, 1, -0.3));
    for (Vec3& target : turned.motion.targets) {
        target = Vec3(target.x * 2, 0, 0);
    }
    cases.push_back(finished(std::move(turned)));

    SelftestCase baked = scene("adaptively baked hammer", 390, 2);
    Progress progress;
    const auto torus = formula_distance({leaf(k::SHAPE_TORUS, {0.35, 0.14, 0})});
    const OccluderModel model = sampled_model(torus, {FieldKind::adaptive, 48}, progress);
    add_occluder(baked.input.occluders, model, "hammer", {}, {InfluenceKind::soft, 0.9, {}, {}, 0},
                 {Vec3(0), diagonal, 1});
    add_hammer(baked, {0.3, 0.2, -0.2}, 0.6, 1.2);
    cases.push_back(finished(std::move(baked)));

    SelftestCase fixed = scene("hammer by equal steps", 380, 1);
    add_occluder(fixed, {leaf(k::SHAPE_TORUS, {0.4, 0.15, 0})}, 381, k::INFLUENCE_HARD);
    add_hammer(fixed, {-0.3, 0.3, 0.2}, 0.5, 0.8);
    fixed.motion.fixed_steps = true;
    fixed.motion.steps = 60;
    cases.push_back(finished(std::move(fixed)));
}

void add_rule_cases(std::vector<SelftestCase>& cases) {
    SelftestCase fixed = scene("100 fixed steps", 400, 2);
    fixed.motion.fixed_steps = true;
    fixed.motion.steps = 100;
    add_occluder(fixed, {leaf(k::SHAPE_SPHERE, {0.4, 0, 0})}, 401, k::INFLUENCE_HARD);
    cases.push_back(finished(std::move(fixed)));

    SelftestCase every = scene("100 fixed steps, none left out", 405, 2);
    every.motion.fixed_steps = true;
    every.motion.every_step = true;
    every.motion.steps = 100;
    add_occluder(every, {leaf(k::SHAPE_SPHERE, {0.4, 0, 0})}, 406);
    cases.push_back(finished(std::move(every)));

    SelftestCase curve = scene("influence curve", 410, 2);
    k::Occluder& curved =
        add_occluder(curve, {leaf(k::SHAPE_TORUS, {0.4, 0.15, 0})}, 411, k::INFLUENCE_CURVE);
    curved.curve = {0, 1};
    curve.input.occluders.segments = smooth_curve().segments;
    cases.push_back(finished(std::move(curve)));

    SelftestCase paper = scene("the paper's influence", 420, 1);
    paper.motion.fixed_steps = true;
    paper.motion.steps = 32;
    paper.input.occluders.paper = true;
    add_occluder(paper, {leaf(k::SHAPE_SPHERE, {0.4, 0, 0})}, 421, k::INFLUENCE_PAPER);
    cases.push_back(finished(std::move(paper)));

    SelftestCase limit = scene("step limit", 430, 2);
    limit.motion.steps = 5;
    add_occluder(limit, {leaf(k::SHAPE_PLANE, {0, 1, 0}, 0)}, 431, k::INFLUENCE_HARD);
    cases.push_back(finished(std::move(limit)));

    SelftestCase several = scene("two occluders", 440, 4);
    add_occluder(several, {leaf(k::SHAPE_SPHERE, {0.35, 0, 0})}, 441);
    add_occluder(several, {leaf(k::SHAPE_CYLINDER, {0.2, 0.5, 0})}, 442, k::INFLUENCE_HARD);
    cases.push_back(finished(std::move(several)));
}

} // namespace

std::vector<SelftestCase> selftest_cases() {
    std::vector<SelftestCase> cases;
    cases.push_back(scene("blend, no handle", 1, 0));
    cases.push_back(scene("blend, 1 handle", 2, 1));
    cases.push_back(scene("blend, 16 handles", 3, 16));
    cases.push_back(scene("one point", 4, 3, 1));
    cases.push_back(scene("no point", 5, 3, 0));
    SelftestCase outside = scene("empty region", 6, 2);
    outside.input.fields.assign(outside.input.fields.size(), infinity);
    add_occluder(outside, {leaf(k::SHAPE_SPHERE, {0.4, 0, 0})}, 7);
    cases.push_back(finished(std::move(outside)));
    add_shape_cases(cases);
    add_motion_cases(cases);
    add_hammer_cases(cases);
    add_rule_cases(cases);
    cases.push_back(sampled_case("sampled field", 500));
    cases.push_back(adaptive_case("adaptive fields", 520));
    return cases;
}

} // namespace anvil

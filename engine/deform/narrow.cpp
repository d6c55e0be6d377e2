#include "engine/deform/narrow.h"

#include <algorithm>
#include <cstddef>

namespace anvil {

static_assert(sizeof(kernel::f32::ShapeSegment) == 20);
static_assert(sizeof(kernel::f32::CurveRange) == 8);
static_assert(sizeof(kernel::f32::ShapeNode) == 80 && offsetof(kernel::f32::ShapeNode, scale) == 76);
static_assert(sizeof(kernel::f32::Occluder) == 120 && offsetof(kernel::f32::Occluder, box_half) == 108);
static_assert(sizeof(kernel::f32::Pose) == 88 && offsetof(kernel::f32::Pose, at) == 84);
static_assert(sizeof(kernel::f32::KernelParams) == 68 &&
              offsetof(kernel::f32::KernelParams, path_epsilon) == 64);
static_assert(sizeof(kernel::f32::VertexResult) == 24);

float narrowed(double x) {
    return static_cast<float>(std::clamp(x, -1e30, 1e30));
}

glm::vec3 narrowed(const Vec3& v) {
    return {narrowed(v.x), narrowed(v.y), narrowed(v.z)};
}

kernel::f32::CurveRange narrowed(const kernel::f64::CurveRange& r) {
    return {r.first, r.count};
}

kernel::f32::ShapeSegment narrowed(const kernel::f64::ShapeSegment& s) {
    return {narrowed(s.begin), narrowed(s.c0), narrowed(s.c1), narrowed(s.c2), narrowed(s.c3)};
}

kernel::f32::ShapeNode narrowed(const kernel::f64::ShapeNode& n) {
    return {n.kind,
            n.volume,
            n.words,
            narrowed(n.size),
            narrowed(n.extra),
            narrowed(n.axis_x),
            narrowed(n.axis_y),
            narrowed(n.axis_z),
            narrowed(n.origin),
            narrowed(n.scale)};
}

kernel::f32::Occluder narrowed(const kernel::f64::Occluder& o) {
    return {narrowed(o.axis_x),     narrowed(o.axis_y),  narrowed(o.axis_z),
            narrowed(o.origin),     narrowed(o.scale),   o.first_node,
            o.node_count,           narrowed(o.margin),  narrowed(o.step),
            narrowed(o.settle),     o.influence,         narrowed(o.strength),
            narrowed(o.width),      narrowed(o.curve),   o.boxed,
            narrowed(o.box_centre), narrowed(o.box_half)};
}

kernel::f32::Pose narrowed(const kernel::f64::Pose& p) {
    return {narrowed(p.axis_x), narrowed(p.axis_y),    narrowed(p.axis_z), narrowed(p.origin),
            narrowed(p.move),   narrowed(p.turn_axis), narrowed(p.turn),   narrowed(p.ratio),
            narrowed(p.growth), narrowed(p.at)};
}

kernel::f32::KernelParams narrowed(const kernel::f64::KernelParams& p) {
    return {p.point_count,
            p.field_stride,
            p.handle_count,
            p.sample_count,
            p.occluder_count,
            p.motion,
            p.steps,
            p.step_limit,
            p.paper,
            p.moving,
            narrowed(p.axis_origin),
            narrowed(p.axis_direction),
            narrowed(p.path_epsilon)};
}

} // namespace anvil

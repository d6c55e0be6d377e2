#include "engine/occluder/shape_nodes.h"

#include "engine/core/error.h"
#include "engine/edit/rotation.h"

#include <algorithm>
#include <string>

namespace anvil {

namespace {

namespace k = kernel::f64;

/// Exact for quarter turns, so that a box turned by 90 degrees keeps its planes.
Placement quarter_exact(Placement p, double degrees) {
    if (std::remainder(degrees, 90.0) == 0) {
        for (Vec3& axis : p.axes) {
            for (int i = 0; i < 3; ++i) {
                const double nearest = std::round(axis[i]);
                axis[i] = std::abs(axis[i] - nearest) < 1e-15 * 8 ? nearest : axis[i];
            }
        }
    }
    return p;
}

/// The leaf's numbers; a visitor over the variant's primitives.
struct LeafNode {
    k::ShapeNode operator()(const SphereShape& s) const { return make(k::SHAPE_SPHERE, {s.radius, 0, 0}, 0); }
    k::ShapeNode operator()(const BoxShape& s) const { return make(k::SHAPE_BOX, s.half, s.rounding); }
    k::ShapeNode operator()(const CylinderShape& s) const {
        return make(k::SHAPE_CYLINDER, {s.radius, 0.5 * s.height, 0}, 0);
    }
    k::ShapeNode operator()(const CapsuleShape& s) const {
        return make(k::SHAPE_CAPSULE, {s.radius, 0.5 * s.height, 0}, 0);
    }
    k::ShapeNode operator()(const ConeShape& s) const {
        return make(k::SHAPE_CONE, {s.radius, 0.5 * s.height, 0}, 0);
    }
    k::ShapeNode operator()(const TorusShape& s) const {
        return make(k::SHAPE_TORUS, {s.major, s.minor, 0}, 0);
    }
    k::ShapeNode operator()(const PlaneShape& s) const {
        return make(k::SHAPE_PLANE, s.normal / glm::length(s.normal), s.offset);
    }
    k::ShapeNode operator()(const MeshShape&) const { throw InternalError("a mesh has no formula"); }
    k::ShapeNode operator()(const VdbShape&) const { throw InternalError("a level set has no formula"); }
    k::ShapeNode operator()(const CsgShape&) const { throw InternalError("a Boolean shape is no leaf"); }

    static k::ShapeNode make(uint32_t kind, const Vec3& size, double extra) {
        k::ShapeNode node{};
        node.kind = kind;
        node.size = size;
        node.extra = extra;
        return node;
    }
};

uint32_t operator_kind(CsgOperation operation) {
    switch (operation) {
    case CsgOperation::unite:
        return k::SHAPE_UNION;
    case CsgOperation::intersect:
        return k::SHAPE_INTERSECTION;
    default:
        return k::SHAPE_SUBTRACTION;
    }
}

void append(const OccluderShape& shape, const Placement& place, std::vector<k::ShapeNode>& nodes) {
    const auto* csg = std::get_if<CsgShape>(&shape.solid);
    if (csg == nullptr) {
        k::ShapeNode node = std::visit(LeafNode{}, shape.solid);
        node.axis_x = place.axes[0];
        node.axis_y = place.axes[1];
        node.axis_z = place.axes[2];
        node.origin = place.origin;
        node.scale = place.scale;
        nodes.push_back(node);
        return;
    }
    for (size_t i = 0; i < csg->parts.size(); ++i) {
        append(csg->parts[i].shape, composed(place, placement(csg->parts[i].transform)), nodes);
        if (i > 0) {
            nodes.push_back(LeafNode::make(operator_kind(csg->operation), Vec3(0), 0));
        }
    }
}

size_t stack_need(const std::vector<k::ShapeNode>& nodes) {
    size_t depth = 0;
    size_t most = 0;
    for (const k::ShapeNode& node : nodes) {
        depth = node.kind >= k::SHAPE_UNION ? depth - 1 : depth + 1;
        most = std::max(most, depth);
    }
    return most;
}

} // namespace

Placement placement(const Transform& transform) {
    Placement result;
    result.origin = transform.translate;
    result.scale = transform.scale;
    const Rotation rotation(Vec3(0), transform.axis);
    for (Vec3& axis : result.axes) {
        axis = rotation.turned(axis, glm::radians(transform.degrees));
    }
    return quarter_exact(result, transform.degrees);
}

Placement composed(const Placement& outer, const Placement& inner) {
    const auto turned = [&](const Vec3& v) {
        return outer.axes[0] * v.x + outer.axes[1] * v.y + outer.axes[2] * v.z;
    };
    Placement result;
    for (int i = 0; i < 3; ++i) {
        result.axes[i] = turned(inner.axes[i]);
    }
    result.origin = outer.origin + outer.scale * turned(inner.origin);
    result.scale = outer.scale * inner.scale;
    return result;
}

std::vector<k::ShapeNode> shape_nodes(const OccluderShape& shape) {
    std::vector<k::ShapeNode> nodes;
    append(shape, Placement{}, nodes);
    if (stack_need(nodes) > k::MAX_SHAPE_STACK) {
        throw InputError("the shape nests " + std::to_string(stack_need(nodes)) +
                         " Boolean operands at once, the most is " + std::to_string(k::MAX_SHAPE_STACK) +
                         ": list the deepest part first");
    }
    return nodes;
}

} // namespace anvil

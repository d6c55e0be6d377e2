#include "engine/occluder/exact_distance.h"

#include "engine/occluder/occluder_kernel.h"

namespace anvil {

namespace {

namespace k = kernel::f64;

/// Box of a leaf in its own space.
Box leaf_box(const k::ShapeNode& node) {
    const Vec3 s = node.size;
    Vec3 half{0};
    switch (node.kind) {
    case k::SHAPE_SPHERE:
        half = Vec3(s.x);
        break;
    case k::SHAPE_BOX:
        half = s;
        break;
    case k::SHAPE_CYLINDER:
    case k::SHAPE_CONE:
        half = {s.x, s.y, s.x};
        break;
    case k::SHAPE_CAPSULE:
        half = {s.x, s.y + s.x, s.x};
        break;
    case k::SHAPE_TORUS:
        half = {s.x + s.y, s.y, s.x + s.y};
        break;
    default:
        half = Vec3(infinity);
    }
    return {-half, half};
}

Box placed_box(const k::ShapeNode& node) {
    const Box box = leaf_box(node);
    if (!is_finite(box.high)) {
        return box;
    }
    Vec3 half{0};
    for (int i = 0; i < 3; ++i) {
        half[i] = std::abs(node.axis_x[i]) * box.high.x + std::abs(node.axis_y[i]) * box.high.y +
                  std::abs(node.axis_z[i]) * box.high.z;
    }
    return {node.origin - node.scale * half, node.origin + node.scale * half};
}

Box overlap(const Box& a, const Box& b) {
    const Box both{glm::max(a.low, b.low), glm::min(a.high, b.high)};
    const bool any = both.low.x <= both.high.x && both.low.y <= both.high.y && both.low.z <= both.high.z;
    return any ? both : Box{};
}

Box combined_box(uint32_t operation, const Box& a, const Box& b) {
    if (operation == k::SHAPE_UNION) {
        return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
    }
    return operation == k::SHAPE_INTERSECTION ? overlap(a, b) : a;
}

class FormulaDistance final : public ExactDistance {
  public:
    explicit FormulaDistance(std::vector<k::ShapeNode> nodes) : nodes_(std::move(nodes)) {}

    SignedDistance at(const Vec3& p) const override {
        k::OccluderKernel kernel;
        kernel.nodes = nodes_.data();
        const auto probe = kernel.shape_probe(0, static_cast<uint32_t>(nodes_.size()), p);
        return {probe.distance, probe.normal};
    }

    Box bounds() const override {
        std::vector<Box> stack;
        for (const k::ShapeNode& node : nodes_) {
            if (node.kind < k::SHAPE_UNION) {
                stack.push_back(placed_box(node));
                continue;
            }
            const Box last = stack.back();
            stack.pop_back();
            stack.back() = combined_box(node.kind, stack.back(), last);
        }
        return stack.back();
    }

  private:
    std::vector<k::ShapeNode> nodes_;
};

} // namespace

std::shared_ptr<const ExactDistance> formula_distance(std::vector<k::ShapeNode> nodes) {
    return std::make_shared<FormulaDistance>(std::move(nodes));
}

} // namespace anvil

#include "engine/mesh/triangle_pairs.h"

namespace anvil {

TrianglePairs::TrianglePairs(const SearchTree& tree) : tree_(tree) {
    // Rounding a number below one to a float moves it by less than this.
    constexpr double rounding = 1e-7;
    const Vec3 middle = tree.nodes_.empty() ? Vec3(0) : tree.nodes_[0].box.centre();
    leaves_.resize((tree.order_.size() + leaf_size - 1) / leaf_size);
    for (uint32_t index = 0; index < tree.nodes_.size(); ++index) {
        const SearchTree::Node& node = tree.nodes_[index];
        if (node.count == 0) {
            continue;
        }
        Leaf& leaf = leaves_[node.first / leaf_size];
        leaf.node = index;
        leaf.low.fill(four(1));
        leaf.high.fill(four(-1));
        for (uint32_t i = 0; i < node.count; ++i) {
            const SearchTree::Corners& t = tree.corners_[node.first + i];
            const Vec3 low = glm::min(glm::min(t.a, t.b), t.c);
            const Vec3 high = glm::max(glm::max(t.a, t.b), t.c);
            for (int axis = 0; axis < 3; ++axis) {
                leaf.low[axis][i] = static_cast<float>((low[axis] - middle[axis]) * tree.scale_ - rounding);
                leaf.high[axis][i] = static_cast<float>((high[axis] - middle[axis]) * tree.scale_ + rounding);
            }
        }
    }
}

} // namespace anvil

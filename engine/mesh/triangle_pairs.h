// Pairs of a mesh's triangles that lie close together.
#pragma once

#include "engine/mesh/search_tree.h"

#include <array>
#include <bit>
#include <vector>

namespace anvil {

/// Finds all pairs of triangles whose boxes touch, and some whose boxes are less than 4e-7 of the mesh's
/// diagonal apart. Triangles are told by their slots in the tree's order(), four a leaf. Built once, used
/// const, from any number of threads.
class TrianglePairs {
  public:
    /// `tree` outlives it.
    explicit TrianglePairs(const SearchTree& tree);

    size_t leaf_count() const { return leaves_.size(); }
    /// visit(slot, other slot) for each pair whose lower slot is in this leaf; the lower one is first.
    template <class Visit>
    void each_of(size_t leaf, const Visit& visit) const {
        const Leaf& from = leaves_[leaf];
        const auto& nodes = tree_.nodes_;
        std::array<uint32_t, SearchTree::stack_size> stack;
        size_t depth = 0;
        stack[depth++] = 0;
        while (depth > 0) {
            const uint32_t index = stack[--depth];
            const SearchTree::Node& node = nodes[index];
            if (!touch(node.box, nodes[from.node].box)) {
                continue;
            }
            if (node.count != 0) {
                each_between(leaf, node.first / leaf_size, visit);
                continue;
            }
            stack[depth++] = node.first;
            if (node.first > from.node) { // else all leaves of the left child come before this one
                stack[depth++] = index + 1;
            }
        }
    }

  private:
    static constexpr size_t leaf_size = SearchTree::leaf_size;

    /// The boxes of four triangles, in units of the mesh's diagonal, somewhat too large.
    struct Leaf {
        std::array<Float4, 3> low, high;
        uint32_t node = 0;
    };

    static bool touch(const Box& a, const Box& b) {
        return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
               a.low.z <= b.high.z && b.low.z <= a.high.z;
    }

    template <class Visit>
    void each_between(size_t leaf, size_t other, const Visit& visit) const {
        const Leaf& a = leaves_[leaf];
        const Leaf& b = leaves_[other];
        for (unsigned i = 0; i < leaf_size; ++i) {
            Int4 apart{};
            for (int axis = 0; axis < 3; ++axis) {
                apart |= four(a.low[axis][i]) > b.high[axis];
                apart |= b.low[axis] > four(a.high[axis][i]);
            }
            unsigned near = ~signs(apart) & 0xfU;
            near &= leaf == other ? 0xeU << i : 0xfU;
            for (; near != 0; near &= near - 1) {
                visit(static_cast<uint32_t>(leaf * leaf_size + i),
                      static_cast<uint32_t>(other * leaf_size + std::countr_zero(near)));
            }
        }
    }

    const SearchTree& tree_;
    std::vector<Leaf> leaves_;
};

} // namespace anvil

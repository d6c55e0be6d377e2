// The nearest point of a triangle mesh, by a tree of boxes.
#pragma once

#include "engine/mesh/flat_triangle.h"

#include <span>
#include <vector>

namespace anvil {

/// The point of the mesh nearest to a query; `triangle` is no_index and `distance` infinite where there is
/// none.
struct ClosestPoint {
    uint32_t triangle = no_index;
    Vec3 barycentric{0}; ///< of `position` in the triangle; each in [0, 1], sum 1
    Vec3 position{0};
    double distance = infinity;

    bool found() const { return triangle != no_index; }
};

/// Where single precision sees a search tree: around the middle of its box, in units of its diagonal.
struct NarrowPlace {
    Vec3 middle{0};
    double scale = 1; ///< to units of the diagonal

    glm::vec3 local(const Vec3& p) const { return glm::vec3(scale * (p - middle)); }
};

/// A search tree in single precision.
struct NarrowTree : NarrowPlace {
    std::vector<kernel::f32::TreeNode> nodes;
    std::vector<kernel::f32::TreeTriangle> triangles; ///< by slot
};

/// A point of a triangle abc, and its squared distance from where it is seen.
struct TrianglePoint {
    double distance2 = infinity;
    Vec3 barycentric{0};
    Vec3 offset{0}; ///< from corner a
};

/// That of triangle abc nearest to p; degenerate ones as for closest_on_triangle().
TrianglePoint nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// The point of triangle abc nearest to p; `triangle` of the result is 0. Degenerate triangles (segments,
/// points) are ordinary: the result is always a point of the triangle, to rounding the nearest.
ClosestPoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Box tree over triangles: built once, used const, from any number of threads. Holds its own copy of the
/// corners (about 170 bytes a triangle). Extents from 1e-70 to 1e70 are safe from under- and overflow.
class SearchTree {
  public:
    /// `triangles` index `positions`, all finite. Building is O(t log t); deterministic.
    SearchTree(std::span<const Vec3> positions, std::span<const Triangle> triangles);

    /// The nearest point no farther than `max_distance` from `query`; equally near ones: the lowest triangle.
    /// Nothing is found in an empty tree, beyond the distance, or for a query that is not finite.
    ClosestPoint closest(const Vec3& query, double max_distance = infinity) const;

    /// Where a ray from `origin` meets a triangle first, from either side; the result's distance is in
    /// lengths of `direction`. Nothing is found where it meets none.
    ClosestPoint first_hit(const Vec3& origin, const Vec3& direction) const;

    /// Of the triangles in these slots, as narrowed() numbers them, the one nearest to a query, which is
    /// finite; equally near ones: the lowest triangle.
    ClosestPoint closest_of(const Vec3& query, std::span<const uint32_t> slots) const;

    /// In single precision, as kernels read it. Its slots are four triangles a leaf, in the leaves' order.
    NarrowTree narrowed() const;

    size_t triangle_count() const { return order_.size(); }
    /// The triangle in each of triangle_count() slots; neighbours of a slot are mostly near it in space.
    std::span<const uint32_t> order() const { return order_; }

  private:
    friend class ClosestPointSearch;
    friend class TrianglePairs;

    // Below this depth the halves are equal in number, so that no arrangement of triangles makes the tree
    // deep.
    static constexpr int balanced_depth = 48;
    static constexpr size_t stack_size = balanced_depth + 40;
    static constexpr size_t leaf_size = 4; ///< what is measured at once; every leaf but the last is full

    struct Node {
        Box box;
        uint32_t first = 0; ///< leaf: first triangle in order_; inner: right child (the left one is next)
        uint32_t count = 0; ///< leaf: triangles; inner: 0
    };
    /// Up to four nodes below one, in single precision, around middle_ in units of the diagonal. `first` of
    /// inner ones: their wide node; of leaves: which of leaves_. What is missing is infinitely far.
    struct WideNode {
        std::array<kernel::f32::TreeNode, 4> children;
    };
    struct Corners {
        Vec3 a, b, c;
    };
    /// The triangles of four slots in single precision. Lengths are in units of the mesh's diagonal, places
    /// in the mesh's own.
    struct Leaf {
        FlatFour flat{};
        std::array<Float4, 3> origins{}; ///< of the triangles' planes, from the centre
        float slack = 0;                 ///< most of the triangles'
        float reach = 0; ///< most of a triangle's longest side and its origin's coordinates from the centre
        Vec3 centre{0};
    };
    /// Around the triangles of four slots, and lying as they do; around middle_ in units of the diagonal.
    struct alignas(64) LeafBox {
        glm::vec3 place{0}; ///< of the centre
        std::array<glm::vec3, 3> axes{};
        glm::vec3 half{0}; ///< size
    };
    /// What the squared distances to a leaf's triangles are at least and at most.
    struct SquaredBounds {
        Float4 low, high;
    };
    struct Item {
        Box box;
        Vec3 centre;
        uint32_t triangle;
    };

    /// Calls visit(leaf) for those with near(box) true all the way down, until it returns false.
    template <class Near, class Visit>
    void each_leaf(const Near& near, const Visit& visit) const {
        std::array<uint32_t, stack_size> stack;
        size_t depth = 0;
        if (!nodes_.empty()) {
            stack[depth++] = 0;
        }
        while (depth > 0) {
            const uint32_t index = stack[--depth];
            const Node& node = nodes_[index];
            if (!near(node.box)) {
                continue;
            }
            if (node.count == 0) {
                stack[depth++] = node.first;
                stack[depth++] = index + 1;
            } else if (!visit(node)) {
                return;
            }
        }
    }

    void build(std::span<Item> items, uint32_t first, int depth);
    static size_t split(std::span<Item> items, int depth);
    void fill_leaves();
    LeafBox fitted_box(std::span<const Corners> triangles) const;
    /// In units of the diagonal; what is not a number bounds nothing.
    SquaredBounds squared_distances(const Leaf& leaf, const Vec3& query) const {
        const glm::vec3 arm((query - leaf.centre) * scale_);
        const std::array<Float4, 3> from_origin{arm.x - leaf.origins[0], arm.y - leaf.origins[1],
                                                arm.z - leaf.origins[2]};
        const auto& [x, y, z] = from_origin;
        const Float4 lengths = leaf.flat.b + absolute(x) + absolute(y) + absolute(z);
        const Float4 error = lengths * (kernel::f32::FLAT_ROUNDING * lengths + 2 * leaf.flat.slack);
        const Float4 squared = squared_distance(leaf.flat, from_origin);
        return {squared - error, squared + error};
    }

    kernel::f32::TreeNode narrow_node(const Node& node) const;
    uint32_t widen(uint32_t index);
    void fill_wide_nodes();

    std::vector<Node> nodes_;
    std::vector<WideNode> wide_nodes_;
    std::vector<Corners> corners_; ///< in the order of order_
    std::vector<Leaf> leaves_;     ///< of slots 4i to 4i + 3
    std::vector<LeafBox> leaf_boxes_;
    double scale_ = 1;            ///< to units of the diagonal
    Vec3 middle_{0};              ///< of the box
    std::vector<uint32_t> order_; ///< triangle of each leaf slot
};

} // namespace anvil

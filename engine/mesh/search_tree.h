// The nearest point of a triangle mesh, by a tree of boxes.
#pragma once

#include "engine/core/types.h"

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

/// The point of triangle abc nearest to p; `triangle` of the result is 0. Degenerate triangles (segments,
/// points) are ordinary: the result is always a point of the triangle, to rounding the nearest.
ClosestPoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Box tree over triangles: built once, used const, from any number of threads. Holds its own copy of the
/// corners (104 bytes a triangle). Extents from 1e-70 to 1e70 are safe from under- and overflow.
class SearchTree {
  public:
    /// `triangles` index `positions`, all finite. Building is O(t log t); deterministic.
    SearchTree(std::span<const Vec3> positions, std::span<const Triangle> triangles);

    /// The nearest point no farther than `max_distance` from `query`; equally near ones: the lowest triangle.
    /// Nothing is found in an empty tree, beyond the distance, or for a query that is not finite.
    ClosestPoint closest(const Vec3& query, double max_distance = infinity) const;

    /// Calls visit(triangle) for every triangle whose box overlaps this one, touching included, and for some
    /// whose box only comes near.
    template <class Visit>
    void each_overlapping(const Box& box, const Visit& visit) const {
        std::vector<uint32_t> stack;
        if (!nodes_.empty()) {
            stack.push_back(0);
        }
        while (!stack.empty()) {
            const uint32_t index = stack.back();
            stack.pop_back();
            const Node& node = nodes_[index];
            if (glm::any(glm::lessThan(node.box.high, box.low)) ||
                glm::any(glm::greaterThan(node.box.low, box.high))) {
                continue;
            }
            for (uint32_t slot = node.first; slot < node.first + node.count; ++slot) {
                visit(order_[slot]);
            }
            if (node.count == 0) {
                stack.push_back(node.first);
                stack.push_back(index + 1);
            }
        }
    }

    size_t triangle_count() const { return order_.size(); }

  private:
    struct Node {
        Box box;
        uint32_t first = 0; ///< leaf: first triangle in order_; inner: right child (the left one is next)
        uint32_t count = 0; ///< leaf: triangles; inner: 0
    };
    struct Corners {
        Vec3 a, b, c;
    };
    struct Sphere {
        Vec3 centre;
        double radius;
    };
    struct Item {
        Box box;
        Vec3 centre;
        uint32_t triangle;
    };

    void build(std::span<Item> items, uint32_t first, int depth);
    static size_t split(std::span<Item> items, int depth);

    std::vector<Node> nodes_;
    std::vector<Corners> corners_; ///< in the order of order_
    std::vector<Sphere> spheres_;  ///< around each leaf slot's triangle
    std::vector<uint32_t> order_;  ///< triangle of each leaf slot
};

} // namespace anvil

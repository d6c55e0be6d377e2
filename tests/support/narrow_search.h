// The search kernel's formulas on the CPU.
#pragma once

#include "engine/mesh/triangle_search.h"

#include <cmath>

namespace anvil {

namespace kernel::f32 {

/// shaders/shared/nearest_triangles.h over a tree that outlives it.
struct NarrowSearchKernel {
    const NarrowTree& tree;
    NearSlots slots;
    uint near_count = 0;

    uint tree_size() const { return static_cast<uint>(tree.nodes.size()); }
    const TreeNode& tree_node(uint i) const { return tree.nodes[i]; }
    const TreeTriangle& tree_triangle(uint i) const { return tree.triangles[i]; }
    void found_near(uint triangle) {
        if (near_count < MOST_NEAR) {
            slots[near_count] = triangle;
        }
        ++near_count;
    }
    static real min(real x, real y) { return std::min(x, y); }
    static real max(real x, real y) { return std::max(x, y); }
    static real3 max(const real3& x, const real3& y) { return glm::max(x, y); }
    static real abs(real x) { return std::abs(x); }
    static real sqrt(real x) { return std::sqrt(x); }
    static real dot(const real3& x, const real3& y) { return glm::dot(x, y); }
    static real least(real x, real y) { return std::min(x, y); }
    static real clamped(real x, real high) { return std::min(std::max(x, 0.0F), high); }
    static real share(real x) { return clamped(x, 1); }

// NOLINTBEGIN: compiled as GLSL too
#include "shaders/shared/flat_triangle.h"

#include "shaders/shared/nearest_triangles.h"
    // NOLINTEND
};

} // namespace kernel::f32

class NarrowSearch final : public TriangleSearch {
  public:
    /// The tree outlives it.
    explicit NarrowSearch(const NarrowTree& tree) : tree_(tree) {}

    bool find(std::span<const glm::vec3> points, std::span<NearSlots> found) override {
        for (size_t i = 0; i < points.size(); ++i) {
            kernel::f32::NarrowSearchKernel kernel{tree_, {}};
            kernel.slots.fill(kernel::f32::NO_TRIANGLE);
            kernel.find_nearest(points[i]);
            found[i] = kernel.slots;
            if (kernel.near_count > kernel::f32::MOST_NEAR) {
                found[i].fill(kernel::f32::NO_TRIANGLE);
            }
        }
        return true;
    }

  private:
    const NarrowTree& tree_;
};

} // namespace anvil

// Boxes of leaves as seen from eight points at once. Internal to engine/mesh.
#pragma once

#include "engine/mesh/flat_triangle.h"

#include <limits>
#include <span>
#include <vector>

// Compiled for AVX2 too, which the program picks where the processor has it, with the same results to the
// bit. Sanitizers are not ready yet when that is picked.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&     \
    !defined(__SANITIZE_THREAD__)
#define ANVIL_FOR_PROCESSOR __attribute__((flatten, target_clones("avx2", "default")))
#else
#define ANVIL_FOR_PROCESSOR
#endif

namespace anvil {

inline constexpr size_t lanes = 8;
inline constexpr size_t quads = lanes / 4;
inline constexpr float largest_float = std::numeric_limits<float>::max();

/// One number of each lane, a lane for one query or one part of a group.
using LaneFloats = std::array<Float4, quads>;

/// From the centre of a group of queries, in units of the mesh's diagonal.
struct LanePoints {
    std::array<LaneFloats, 3> at{};

    void set(size_t lane, const Vec3& p) {
        for (int axis = 0; axis < 3; ++axis) {
            at[axis][lane / 4][lane % 4] = static_cast<float>(p[axis]);
        }
    }
};

/// Triangles that may be nearest to one of a group of queries, by their box.
struct NearLeaf {
    glm::vec3 centre; ///< from the group's centre
    std::array<glm::vec3, 3> axes;
    glm::vec3 half;
    uint32_t index; ///< in the tree
};

/// A leaf's box as seen from the lanes' points.
struct LeafView {
    LaneFloats squared;            ///< distance
    std::array<LaneFloats, 3> arm; ///< to the nearest point, along the box's axes; only where asked for
};

/// One view for each leaf of a list of some.
class LeafViews {
  public:
    /// Looks at leaves[i] for each i of the list, which is not empty; which of the list is nearest to each
    /// lane.
    template <bool Arms>
    std::array<uint32_t, lanes> look(std::span<const NearLeaf> leaves, std::span<const uint32_t> list,
                                     const LanePoints& p) {
        views_.resize(list.size());
        LaneFloats lowest;
        lowest.fill(four(largest_float));
        std::array<Int4, quads> nearest{};
        for (size_t i = 0; i < list.size(); ++i) {
            const NearLeaf& leaf = leaves[list[i]];
            const int k = static_cast<int>(i);
            for (size_t quad = 0; quad < quads; ++quad) {
                const Float4 squared = look_from<Arms>(views_[i], leaf, p, quad);
                const auto nearer = squared < lowest[quad];
                lowest[quad] = nearer ? squared : lowest[quad];
                nearest[quad] = nearer ? Int4{k, k, k, k} : nearest[quad];
            }
        }
        std::array<uint32_t, lanes> result;
        for (size_t lane = 0; lane < lanes; ++lane) {
            result[lane] = static_cast<uint32_t>(nearest[lane / 4][lane % 4]);
        }
        return result;
    }

    /// Of the list's entry i.
    const LeafView& operator[](size_t i) const { return views_[i]; }

  private:
    template <bool Arms>
    static Float4 look_from(LeafView& view, const NearLeaf& leaf, const LanePoints& p, size_t quad) {
        const Float4 x = p.at[0][quad] - leaf.centre.x;
        const Float4 y = p.at[1][quad] - leaf.centre.y;
        const Float4 z = p.at[2][quad] - leaf.centre.z;
        Float4 squared{};
        for (int axis = 0; axis < 3; ++axis) {
            const Float4 at = leaf.axes[axis].x * x + leaf.axes[axis].y * y + leaf.axes[axis].z * z;
            const float half = leaf.half[axis];
            const Float4 arm = most(-half - at, least(half - at, Float4{}));
            if constexpr (Arms) {
                view.arm[axis][quad] = arm;
            }
            squared += arm * arm;
        }
        view.squared[quad] = squared;
        return squared;
    }

    std::vector<LeafView> views_;
};

} // namespace anvil

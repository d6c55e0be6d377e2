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
inline constexpr float largest_float = std::numeric_limits<float>::max();

/// One number of each lane, a lane for one query or one part of a group. Not returned by value, and what
/// holds them says how it is aligned: with and without AVX compilers do these differently.
using LaneFloats = float __attribute__((vector_size(4 * lanes)));
using LaneInts = int __attribute__((vector_size(4 * lanes)));

inline constexpr size_t lane_alignment = 4 * lanes;

inline void fill(LaneFloats& all, float x) {
    all = LaneFloats{} + x;
}

inline void take_root(LaneFloats& x) {
    const Float4 low = square_root(__builtin_shufflevector(x, x, 0, 1, 2, 3));
    const Float4 high = square_root(__builtin_shufflevector(x, x, 4, 5, 6, 7));
    x = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Bit i: whether number i is negative.
inline unsigned signs(const LaneInts& x) {
    return signs(__builtin_shufflevector(x, x, 0, 1, 2, 3)) | signs(__builtin_shufflevector(x, x, 4, 5, 6, 7))
                                                                  << 4;
}

/// From the centre of a group of queries, in units of the mesh's diagonal.
struct alignas(lane_alignment) LanePoints {
    std::array<LaneFloats, 3> at{};

    void set(size_t lane, const Vec3& p) {
        for (int axis = 0; axis < 3; ++axis) {
            at[axis][lane] = static_cast<float>(p[axis]);
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
struct alignas(lane_alignment) LeafView {
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
        fill(lowest, largest_float);
        LaneInts nearest{};
        for (size_t i = 0; i < list.size(); ++i) {
            look_at<Arms>(views_[i], leaves[list[i]], p);
            const auto nearer = views_[i].squared < lowest;
            lowest = nearer ? views_[i].squared : lowest;
            nearest = nearer ? LaneInts{} + static_cast<int>(i) : nearest;
        }
        std::array<uint32_t, lanes> result;
        for (size_t lane = 0; lane < lanes; ++lane) {
            result[lane] = static_cast<uint32_t>(nearest[lane]);
        }
        return result;
    }

    /// Of the list's entry i.
    const LeafView& operator[](size_t i) const { return views_[i]; }

  private:
    template <bool Arms>
    static void look_at(LeafView& view, const NearLeaf& leaf, const LanePoints& p) {
        const LaneFloats x = p.at[0] - leaf.centre.x;
        const LaneFloats y = p.at[1] - leaf.centre.y;
        const LaneFloats z = p.at[2] - leaf.centre.z;
        LaneFloats squared{};
        for (int axis = 0; axis < 3; ++axis) {
            const LaneFloats at = leaf.axes[axis].x * x + leaf.axes[axis].y * y + leaf.axes[axis].z * z;
            const LaneFloats above = leaf.half[axis] - at;
            const LaneFloats below = -leaf.half[axis] - at;
            const LaneFloats down = above < 0 ? above : LaneFloats{};
            const LaneFloats arm = below > down ? below : down;
            if constexpr (Arms) {
                view.arm[axis] = arm;
            }
            squared += arm * arm;
        }
        view.squared = squared;
    }

    std::vector<LeafView> views_;
};

} // namespace anvil

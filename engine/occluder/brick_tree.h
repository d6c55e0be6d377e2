// The octree of bricks that an adaptive field is baked into, while it is built; internal to engine/occluder.
#pragma once

#include "engine/core/progress.h"
#include "engine/occluder/exact_distance.h"
#include "engine/occluder/kernel_types.h"

#include <array>
#include <vector>

namespace anvil {

/// Place in the finest level's cells, or in bricks of some level.
using CellIndex = glm::ivec3;

inline constexpr int brick_cells = kernel::f64::BRICK_CELLS;
inline constexpr int brick_side = kernel::f64::BRICK_SIDE;
inline constexpr int brick_samples = brick_side * brick_side * brick_side;

inline int sample_index(const CellIndex& sample) {
    return sample.x + brick_side * (sample.y + brick_side * sample.z);
}
inline CellIndex sample_place(int index) {
    return {index % brick_side, index / brick_side % brick_side, index / (brick_side * brick_side)};
}

/// (normal, distance in voxels) at the corners of a brick's cells, x fastest.
using BrickSamples = std::array<glm::vec4, brick_samples>;

/// A cube of cells, each 2^level finest cells wide. Of its eight octants those in `refined` (bit x + 2y + 4z)
/// are covered by bricks of the level below.
struct Brick {
    CellIndex place{0}; ///< in bricks of its level
    int level = 0;
    uint8_t refined = 0;
    int range = 0; ///< exponent of what distances are stored in units of
    BrickSamples samples;

    /// What distances are stored in units of, in voxels.
    double unit() const { return (1 << range) / kernel::f64::BRICK_DISTANCES; }

    /// Of the brick's low corner, in finest cells.
    CellIndex origin() const { return (place * brick_cells) << level; }
    /// Trilinear interpolation at a point in finest cells.
    glm::dvec4 interpolated(const Vec3& cells) const;
};

/// The box of an adaptive field: `low` its corner, `grid` its size in finest bricks.
struct BrickLayout {
    Vec3 low{0};
    double voxel = 0;
    glm::ivec3 grid{0};
    int top_level = 0; ///< of the roots; `grid` is a multiple of 2^top_level

    Vec3 point(const Vec3& cells) const { return low + voxel * cells; }
};

/// Fine enough bricks of the whole box, coarse levels first; `error`: see AdaptiveField, in voxels, not
/// limited. With a device, if there is one (see ExactDistance::tracer_with()). @throws Cancelled, DeviceError
struct BrickTree {
    BrickLayout layout;
    std::vector<Brick> bricks;
    double error = 0;
};
BrickTree grow_bricks(const ExactDistance& solid, const BrickLayout& layout, Progress& progress,
                      SearchDevice* device);

/// Index into tree.bricks of the brick that covers each finest brick's place, x fastest.
std::vector<uint32_t> brick_table(const BrickTree& tree);

/// Gives the samples on faces shared with coarser bricks the values that those interpolate there; finds the
/// ranges, and rounds all distances to what is stored.
void stitch_levels(BrickTree& tree, const std::vector<uint32_t>& table);

} // namespace anvil

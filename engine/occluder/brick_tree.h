// The octree of bricks that an adaptive field is baked into, while it is built; internal to engine/occluder.
#pragma once

#include "engine/core/progress.h"
#include "engine/occluder/exact_distance.h"
#include "engine/occluder/kernel_types.h"

#include <algorithm>
#include <array>
#include <cmath>
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

/// The whole number nearest to x, halves away from zero; |x| < 2^31.
inline int nearest_whole(double x) {
    // Half of the last digit less than a half: what is below a half is not to reach one by rounding.
    return static_cast<int>(x + std::copysign(0.49999999999999994, x));
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

    Brick() {} // NOLINT(modernize-use-equals-default): the default would clear the samples first

    /// What distances are stored in units of, in voxels.
    double unit() const { return (1 << range) / kernel::f64::BRICK_DISTANCES; }

    /// Of the brick's low corner, in finest cells.
    CellIndex origin() const { return (place * brick_cells) << level; }
    /// Trilinear interpolation at a point in finest cells.
    glm::dvec4 interpolated(const Vec3& cells) const;
};

// Here so that what is not asked for, distance or normal, is not computed.
inline glm::dvec4 Brick::interpolated(const Vec3& cells) const {
    const Vec3 within = (cells - Vec3(origin())) / static_cast<double>(1 << level);
    const CellIndex low(std::clamp(static_cast<int>(within.x), 0, brick_cells - 1),
                        std::clamp(static_cast<int>(within.y), 0, brick_cells - 1),
                        std::clamp(static_cast<int>(within.z), 0, brick_cells - 1));
    const Vec3 t = within - Vec3(low);
    const glm::vec4* first = &samples[sample_index(low)];
    glm::dvec4 sum(0);
    for (int corner = 0; corner < 8; ++corner) {
        const int dx = corner & 1;
        const int dy = corner >> 1 & 1;
        const int dz = corner >> 2;
        const double weight = (dx ? t.x : 1 - t.x) * (dy ? t.y : 1 - t.y) * (dz ? t.z : 1 - t.z);
        sum += weight * glm::dvec4(first[sample_index({dx, dy, dz})]);
    }
    return sum;
}

/// The box of an adaptive field: `low` its corner, `grid` its size in finest bricks.
struct BrickLayout {
    Vec3 low{0};
    double voxel = 0;
    glm::ivec3 grid{0};
    int top_level = 0;     ///< of the roots; `grid` is a multiple of 2^top_level
    double soft_width = 0; ///< that of a soft influence by default, in voxels

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

#include "engine/occluder/adaptive_field.h"

#include "engine/core/error.h"
#include "engine/occluder/brick_tree.h"
#include "engine/occluder/distance_volume.h"
#include "engine/occluder/occluder_kernel.h"

#include <cmath>

namespace anvil {

namespace {

namespace k = kernel::f64;

constexpr int most_levels = 5;
constexpr int least_roots = 4; // along the longest side

/// The box of bake() with at least its padding, in whole roots; the finest samples are those of bake(), so
/// that near the surface, where both err by more than what is rounded here, both err alike.
BrickLayout layout(const Box& box, uint32_t resolution) {
    const VoxelGrid wanted = voxel_grid(box, resolution);
    BrickLayout result;
    result.voxel = wanted.voxel;
    const glm::ivec3 cells(wanted.size[0] - 1, wanted.size[1] - 1, wanted.size[2] - 1);
    result.grid = (cells + (brick_cells - 1)) / brick_cells;
    const int longest = std::max({result.grid.x, result.grid.y, result.grid.z});
    while (result.top_level < most_levels && longest >> (result.top_level + 1) >= least_roots) {
        ++result.top_level;
    }
    const int block = 1 << result.top_level;
    result.grid = (result.grid + (block - 1)) / block * block;
    const glm::ivec3 beyond = (result.grid * brick_cells - cells) / 2;
    result.soft_width = default_soft_width * 0.5 * box.diagonal() / result.voxel;
    result.low = box.centre() - result.voxel * (0.5 * Vec3(cells) + Vec3(beyond));
    return result;
}

/// The lowest `bits` of a whole number, negative ones as their complement.
uint32_t low_bits(double x, int bits) {
    return static_cast<uint32_t>(nearest_whole(x)) & ((1U << bits) - 1);
}

/// Distance in its brick's unit, and the octahedral map of the normal: the sphere unfolded to a square.
uint32_t packed(const glm::vec4& sample, double unit) {
    Vec3 n(sample);
    const double size = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    n = size > 0 ? n / size : Vec3(0, 1, 0);
    if (n.z < 0) {
        const double x = (n.x < 0 ? -1 : 1) * (1 - std::abs(n.y));
        n.y = (n.y < 0 ? -1 : 1) * (1 - std::abs(n.x));
        n.x = x;
    }
    return low_bits(sample.w / unit, 12) | low_bits(n.x * k::BRICK_NORMALS, 10) << 12 |
           low_bits(n.y * k::BRICK_NORMALS, 10) << 22;
}

std::vector<uint32_t> packed(const BrickTree& tree, const std::vector<uint32_t>& table) {
    const size_t count = table.size() + tree.bricks.size() * brick_samples;
    if (count >= size_t{1} << k::BRICK_RANGE_SHIFT) {
        throw InputError("the adaptive field would take " + std::to_string(count >> 18) +
                         " MiB, more than a kernel can address; lower its \"resolution\"");
    }
    std::vector<uint32_t> words;
    words.reserve(count);
    for (const uint32_t b : table) {
        words.push_back(static_cast<uint32_t>(table.size() + size_t{b} * brick_samples) |
                        static_cast<uint32_t>(tree.bricks[b].range) << k::BRICK_RANGE_SHIFT |
                        static_cast<uint32_t>(tree.bricks[b].level) << k::BRICK_LEVEL_SHIFT);
    }
    for (const Brick& brick : tree.bricks) {
        for (const glm::vec4& sample : brick.samples) {
            words.push_back(packed(sample, brick.unit()));
        }
    }
    return words;
}

} // namespace

glm::dvec4 AdaptiveField::texel(const Vec3& p) const {
    k::ShapeNode node{};
    node.size = half_size;
    node.extra = voxel;
    k::OccluderKernel kernel;
    kernel.field_words = words.data();
    return kernel.brick_texel(node, p - centre);
}

double adaptive_tolerance(double distance) {
    return 0.05 + 0.04 * std::max(0.0, std::abs(distance) - 2);
}

AdaptiveField bake_adaptive(const ExactDistance& solid, uint32_t resolution, Progress& progress,
                            SearchDevice* device) {
    BrickTree tree = grow_bricks(solid, layout(bakeable_box(solid), resolution), progress, device);
    const std::vector<uint32_t> table = brick_table(tree);
    stitch_levels(tree, table);
    AdaptiveField field;
    for (int i = 0; i < 3; ++i) {
        field.grid[i] = static_cast<uint32_t>(tree.layout.grid[i]);
    }
    field.voxel = tree.layout.voxel;
    field.half_size = 0.5 * field.voxel * brick_cells * Vec3(tree.layout.grid);
    field.centre = tree.layout.low + field.half_size;
    field.error = std::min(tree.error, 0.25) * field.voxel;
    field.words = packed(tree, table);
    return field;
}

} // namespace anvil

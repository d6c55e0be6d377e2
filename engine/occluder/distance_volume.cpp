#include "engine/occluder/distance_volume.h"

#include "engine/core/error.h"
#include "engine/core/parallel_for.h"
#include "engine/occluder/trilinear.h"

#include <cmath>
#include <mutex>

namespace anvil {

namespace {

constexpr double padding_voxels = 3; // beyond the solid on each side: margin and half a step lie inside

Vec3 voxel_centre(const DistanceVolume& volume, const Vec3& voxel) {
    return volume.centre - volume.half_size + volume.voxel * voxel;
}

DistanceVolume layout(const Box& box, uint32_t resolution) {
    const VoxelGrid grid = voxel_grid(box, resolution);
    DistanceVolume volume;
    volume.voxel = grid.voxel;
    volume.size = grid.size;
    volume.centre = box.centre();
    for (int i = 0; i < 3; ++i) {
        volume.half_size[i] = 0.5 * volume.voxel * (volume.size[i] - 1);
    }
    return volume;
}

/// Voxels or cells of a block along a side: what is asked for at once.
constexpr size_t block_size = 8;

/// Voxels or cells from `low` on, up to `high`.
struct Block {
    std::array<size_t, 3> low;
    std::array<size_t, 3> high;

    template <class Visit>
    void each_place(const Visit& visit) const {
        for (size_t z = low[2]; z < high[2]; ++z) {
            for (size_t y = low[1]; y < high[1]; ++y) {
                for (size_t x = low[0]; x < high[0]; ++x) {
                    visit(x, y, z);
                }
            }
        }
    }
};

void fill_block(DistanceVolume& volume, DistanceTracer& tracer, const Block& block) {
    std::vector<Vec3> points;
    block.each_place(
        [&](size_t x, size_t y, size_t z) { points.push_back(voxel_centre(volume, Vec3(x, y, z))); });
    std::vector<SignedDistance> found(points.size());
    tracer.trace(points, found);
    auto next = found.begin();
    block.each_place([&](size_t x, size_t y, size_t z) {
        float* texel = &volume.texels[volume.texel_index(x, y, z)];
        for (int i = 0; i < 3; ++i) {
            *texel++ = static_cast<float>(next->normal[i]);
        }
        *texel = static_cast<float>(next++->distance);
    });
}

/// Largest interpolation error at the cell centres of a block that the surface is near to.
double block_error(const DistanceVolume& volume, DistanceTracer& tracer, const Block& block) {
    const Vec3 cells(volume.size[0] - 1, volume.size[1] - 1, volume.size[2] - 1);
    std::vector<Vec3> points;
    std::vector<double> interpolated;
    block.each_place([&](size_t x, size_t y, size_t z) {
        if (std::abs(volume.texels[volume.texel_index(x, y, z) + 3]) <= 2 * volume.voxel) {
            const Vec3 cell = Vec3(x, y, z) + Vec3(0.5);
            points.push_back(voxel_centre(volume, cell));
            interpolated.push_back(volume.texel(cell / cells).w);
        }
    });
    std::vector<SignedDistance> found(points.size());
    tracer.trace(points, found);
    double worst = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        worst = std::max(worst, std::abs(interpolated[i] - found[i].distance));
    }
    return worst;
}

/// Cuts up a layer of blocks, z and up, of so many voxels or cells.
std::vector<Block> blocks_of_layer(const std::array<size_t, 3>& size, size_t z) {
    const size_t top = std::min(z + block_size, size[2]);
    std::vector<Block> blocks;
    for (size_t y = 0; y < size[1]; y += block_size) {
        for (size_t x = 0; x < size[0]; x += block_size) {
            blocks.push_back(
                {{x, y, z}, {std::min(x + block_size, size[0]), std::min(y + block_size, size[1]), top}});
        }
    }
    return blocks;
}

/// Calls work(tracer, block) for what makes up a layer: blocks on all cores, or all of it on the device.
template <class Work>
void for_layer(const ExactDistance& solid, DistanceTracer* on_device, const std::array<size_t, 3>& size,
               size_t z, const Work& work) {
    if (on_device != nullptr) {
        work(*on_device, Block{{0, 0, z}, {size[0], size[1], std::min(z + block_size, size[2])}});
        return;
    }
    const std::vector<Block> blocks = blocks_of_layer(size, z);
    parallel_for(blocks.size(), 1, [&](size_t begin, size_t end) {
        const std::unique_ptr<DistanceTracer> tracer = solid.tracer();
        for (size_t i = begin; i < end; ++i) {
            work(*tracer, blocks[i]);
        }
    });
}

} // namespace

glm::dvec4 DistanceVolume::texel(const Vec3& uvw) const {
    return trilinear_texel(*this, uvw);
}

VoxelGrid voxel_grid(const Box& box, uint32_t resolution) {
    const Vec3 extent = box.high - box.low;
    const double longest = std::max({extent.x, extent.y, extent.z});
    VoxelGrid grid;
    grid.voxel = longest / std::max(1.0, resolution - 1 - 2 * padding_voxels);
    for (int i = 0; i < 3; ++i) {
        grid.size[i] =
            static_cast<uint32_t>(std::ceil(extent[i] / grid.voxel - 1e-9) + 2 * padding_voxels) + 1;
    }
    return grid;
}

Box bakeable_box(const ExactDistance& solid) {
    const Box box = solid.bounds();
    if (box.empty() || !is_finite(box.low) || !is_finite(box.high) || !(box.diagonal() > 0)) {
        throw InputError("only a bounded solid with an extent can be baked into a distance field");
    }
    return box;
}

DistanceVolume bake(const ExactDistance& solid, uint32_t resolution, Progress& progress,
                    SearchDevice* device) {
    DistanceVolume volume = layout(bakeable_box(solid), resolution);
    volume.texels.resize(4 * size_t{volume.size[0]} * volume.size[1] * volume.size[2]);
    const auto on_device = device != nullptr ? solid.tracer_with(*device) : nullptr;
    const std::array<size_t, 3> voxels{volume.size[0], volume.size[1], volume.size[2]};
    for (size_t z = 0; z < voxels[2]; z += block_size) {
        progress.report("bake", static_cast<double>(z) / volume.size[2]);
        for_layer(solid, on_device.get(), voxels, z,
                  [&](DistanceTracer& tracer, const Block& block) { fill_block(volume, tracer, block); });
    }
    const std::array<size_t, 3> cells{voxels[0] - 1, voxels[1] - 1, voxels[2] - 1};
    std::mutex mutex;
    for (size_t z = 0; z < cells[2]; z += block_size) {
        for_layer(solid, on_device.get(), cells, z, [&](DistanceTracer& tracer, const Block& block) {
            const double error = block_error(volume, tracer, block);
            const std::lock_guard lock(mutex);
            volume.error = std::max(volume.error, error);
        });
    }
    volume.error = std::min(volume.error, 0.25 * volume.voxel);
    return volume;
}

} // namespace anvil

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

/// Voxels or cells of a block: what is asked for at once.
constexpr size_t block_size = 8;

template <class Visit>
void each_place(size_t block_x, size_t block_y, size_t block_z, const std::array<size_t, 3>& size,
                const Visit& visit) {
    for (size_t z = block_z; z < std::min(block_z + block_size, size[2]); ++z) {
        for (size_t y = block_y; y < std::min(block_y + block_size, size[1]); ++y) {
            for (size_t x = block_x; x < std::min(block_x + block_size, size[0]); ++x) {
                visit(x, y, z);
            }
        }
    }
}

void fill_block(DistanceVolume& volume, const ExactDistance& solid, size_t x0, size_t y0, size_t z0) {
    const std::array<size_t, 3> size{volume.size[0], volume.size[1], volume.size[2]};
    std::vector<Vec3> points;
    each_place(x0, y0, z0, size,
               [&](size_t x, size_t y, size_t z) { points.push_back(voxel_centre(volume, Vec3(x, y, z))); });
    std::vector<SignedDistance> found(points.size());
    solid.tracer()->trace(points, found);
    auto next = found.begin();
    each_place(x0, y0, z0, size, [&](size_t x, size_t y, size_t z) {
        float* texel = &volume.texels[volume.texel_index(x, y, z)];
        for (int i = 0; i < 3; ++i) {
            *texel++ = static_cast<float>(next->normal[i]);
        }
        *texel = static_cast<float>(next++->distance);
    });
}

/// Largest interpolation error at the cell centres of a block that the surface is near to.
double block_error(const DistanceVolume& volume, const ExactDistance& solid, size_t x0, size_t y0,
                   size_t z0) {
    const std::array<size_t, 3> cells{volume.size[0] - 1, volume.size[1] - 1, volume.size[2] - 1};
    std::vector<Vec3> points;
    std::vector<double> interpolated;
    each_place(x0, y0, z0, cells, [&](size_t x, size_t y, size_t z) {
        if (std::abs(volume.texels[volume.texel_index(x, y, z) + 3]) <= 2 * volume.voxel) {
            const Vec3 cell = Vec3(x, y, z) + Vec3(0.5);
            points.push_back(voxel_centre(volume, cell));
            interpolated.push_back(volume.texel(cell / Vec3(cells[0], cells[1], cells[2])).w);
        }
    });
    std::vector<SignedDistance> found(points.size());
    solid.tracer()->trace(points, found);
    double worst = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        worst = std::max(worst, std::abs(interpolated[i] - found[i].distance));
    }
    return worst;
}

/// Calls work(x, y) for the low corners of a layer's blocks, on all cores.
template <class Work>
void for_blocks(const DistanceVolume& volume, const Work& work) {
    const size_t columns = (volume.size[0] + block_size - 1) / block_size;
    const size_t rows = (volume.size[1] + block_size - 1) / block_size;
    parallel_for(columns * rows, 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            work(i % columns * block_size, i / columns * block_size);
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

DistanceVolume bake(const ExactDistance& solid, uint32_t resolution, Progress& progress) {
    DistanceVolume volume = layout(bakeable_box(solid), resolution);
    volume.texels.resize(4 * size_t{volume.size[0]} * volume.size[1] * volume.size[2]);
    for (size_t z = 0; z < volume.size[2]; z += block_size) {
        progress.report("bake", static_cast<double>(z) / volume.size[2]);
        for_blocks(volume, [&](size_t x, size_t y) { fill_block(volume, solid, x, y, z); });
    }
    std::mutex mutex;
    for (size_t z = 0; z < volume.size[2]; z += block_size) {
        for_blocks(volume, [&](size_t x, size_t y) {
            const double error = block_error(volume, solid, x, y, z);
            const std::lock_guard lock(mutex);
            volume.error = std::max(volume.error, error);
        });
    }
    volume.error = std::min(volume.error, 0.25 * volume.voxel);
    return volume;
}

} // namespace anvil

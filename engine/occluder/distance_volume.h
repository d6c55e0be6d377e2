// The content of a baked 3D texture: outward normal and signed distance at voxel centres.
#pragma once

#include "engine/core/progress.h"
#include "engine/core/types.h"
#include "engine/occluder/exact_distance.h"

#include <array>
#include <vector>

namespace anvil {

/// Dense signed distance field of a bounded solid, in the occluder's own space.
/// Voxel (x, y, z) has its centre at centre - half_size + voxel * (x, y, z); size[i] = 1 + 2 half_size[i] /
/// voxel.
struct DistanceVolume {
    std::array<uint32_t, 3> size{};
    Vec3 centre{0};
    Vec3 half_size{0}; ///< of the box of the outermost voxel centres
    double voxel = 0;  ///< width, the same along all axes
    double error =
        0; ///< largest |trilinear - exact| seen at cell centres near the surface, at most voxel / 4
    std::vector<float> texels; ///< 4 per voxel: normal x, y, z, distance; x fastest

    /// Where the numbers of voxel (x, y, z) begin in `texels`.
    size_t texel_index(size_t x, size_t y, size_t z) const { return 4 * (x + size[0] * (y + size[1] * z)); }
    /// Interpolated as trilinear_texel() does.
    glm::dvec4 texel(const Vec3& uvw) const;
};

/// Where bake() puts its voxels: `resolution` along the longest side of the box plus padding.
struct VoxelGrid {
    double voxel = 0;
    std::array<uint32_t, 3> size{};
};
VoxelGrid voxel_grid(const Box& box, uint32_t resolution);

/// The solid's bounds. @throws InputError if it is unbounded or has no extent.
Box bakeable_box(const ExactDistance& solid);

/// Samples `solid` on a grid with `resolution` voxels along the longest side of its bounds plus padding.
/// With a device, if there is one: the field is the same but where triangles are equally near.
/// @throws InputError if the solid is unbounded or has no extent; Cancelled; DeviceError.
DistanceVolume bake(const ExactDistance& solid, uint32_t resolution, Progress& progress,
                    SearchDevice* device = nullptr);

} // namespace anvil

// The content of a baked adaptive field: small bricks of samples, fine near the surface and coarse far away.
#pragma once

#include "engine/core/progress.h"
#include "engine/core/types.h"
#include "engine/occluder/exact_distance.h"

#include <array>
#include <vector>

namespace anvil {

/// Adaptively sampled signed distance field (Frisken et al. 2000) of a bounded solid, in the occluder's own
/// space: an octree of bricks over a box, flattened to a table at its finest level. The interpolation error
/// is kept under adaptive_tolerance(), or the finest level's where that has more; near the surface this holds
/// at all points of the finest grid, so that contact has one step width everywhere. Outside, as far as a soft
/// influence of default_soft_width acts much, coarse bricks are held by their normals too, since these are
/// what it pushes along. Where levels meet, the finer brick's samples are the coarser one's interpolation:
/// the field has no cracks but the rounding to 12 bits.
///
/// A sample (normal and distance) takes one word of 32 bits and is interpolated by the kernels themselves:
/// formats that textures filter take 6 to 8 bytes for the same, twice the memory that fields should take;
/// the distance alone, with its gradient for the normal, would have facets.
struct AdaptiveField {
    std::array<uint32_t, 3> grid{}; ///< bricks of the finest level
    Vec3 centre{0};
    Vec3 half_size{0};           ///< of the box of the outermost samples
    double voxel = 0;            ///< width of the finest level's cells
    double error = 0;            ///< largest |interpolated - exact| seen near the surface, at most voxel / 4
    std::vector<uint32_t> words; ///< table and samples, see shaders/shared/kernel_types.h

    /// Interpolated (normal, distance) at a point of the box, as kernels compute it: the normal of any
    /// length.
    glm::dvec4 texel(const Vec3& p) const;
    size_t bytes() const { return words.size() * sizeof(uint32_t); }
};

/// Width of a soft influence that says none, in radii of the occluder's bounding sphere.
inline constexpr double default_soft_width = 0.05;

/// What the interpolation may be off at a true distance, both in voxels: a little near the surface, then in
/// proportion, so that the steps that the kernels take by the distance stay safe.
double adaptive_tolerance(double distance);

/// Samples `solid` as bake() would with `resolution` voxels along the longest side of its bounds plus
/// padding. With a device, if there is one: the field is the same but where triangles are equally near.
/// @throws InputError if the solid is unbounded or has no extent; Cancelled; DeviceError.
AdaptiveField bake_adaptive(const ExactDistance& solid, uint32_t resolution, Progress& progress,
                            SearchDevice* device = nullptr);

} // namespace anvil

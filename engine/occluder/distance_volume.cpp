#include "engine/occluder/distance_volume.h"

#include "engine/core/error.h"
#include "engine/core/parallel_for.h"
#include "engine/occluder/trilinear.h"

#include <cmath>

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

void fill_row(DistanceVolume& volume, const ExactDistance& solid, size_t y, size_t z) {
    std::vector<Vec3> points;
    for (size_t x = 0; x < volume.size[0]; ++x) {
        points.push_back(voxel_centre(volume, Vec3(x, y, z)));
    }
    std::vector<SignedDistance> found(points.size());
    solid.trace(points, found);
    float* texel = &volume.texels[volume.texel_index(0, y, z)];
    for (const SignedDistance& s : found) {
        for (int i = 0; i < 3; ++i) {
            *texel++ = static_cast<float>(s.normal[i]);
        }
        *texel++ = static_cast<float>(s.distance);
    }
}

/// Largest interpolation error at the cell centres of one layer that the surface is near to.
double layer_error(const DistanceVolume& volume, const ExactDistance& solid, size_t z) {
    double worst = 0;
    for (size_t y = 0; y + 1 < volume.size[1]; ++y) {
        for (size_t x = 0; x + 1 < volume.size[0]; ++x) {
            if (std::abs(volume.texels[volume.texel_index(x, y, z) + 3]) > 2 * volume.voxel) {
                continue;
            }
            const Vec3 cell = Vec3(x, y, z) + Vec3(0.5);
            const Vec3 last(volume.size[0] - 1, volume.size[1] - 1, volume.size[2] - 1);
            const double interpolated = volume.texel(cell / last).w;
            worst = std::max(worst, std::abs(interpolated - solid.at(voxel_centre(volume, cell)).distance));
        }
    }
    return worst;
}

double measured_error(const DistanceVolume& volume, const ExactDistance& solid) {
    std::vector<double> errors(volume.size[2] - 1, 0.0);
    parallel_for(errors.size(), 1, [&](size_t begin, size_t end) {
        for (size_t z = begin; z < end; ++z) {
            errors[z] = layer_error(volume, solid, z);
        }
    });
    return *std::max_element(errors.begin(), errors.end());
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
    constexpr size_t layers_at_once = 8;
    for (size_t z0 = 0; z0 < volume.size[2]; z0 += layers_at_once) {
        progress.report("bake", static_cast<double>(z0) / volume.size[2]);
        const size_t z1 = std::min<size_t>(z0 + layers_at_once, volume.size[2]);
        parallel_for((z1 - z0) * volume.size[1], 1, [&](size_t begin, size_t end) {
            for (size_t row = begin; row < end; ++row) {
                fill_row(volume, solid, row % volume.size[1], z0 + row / volume.size[1]);
            }
        });
    }
    volume.error = std::min(measured_error(volume, solid), 0.25 * volume.voxel);
    return volume;
}

} // namespace anvil

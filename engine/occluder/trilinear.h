// How a dense field is interpolated on the CPU.
#pragma once

#include "engine/occluder/distance_volume.h"

#include <algorithm>
#include <array>

namespace anvil {

/// Trilinear (normal, distance) at uvw in [0, 1] between the outermost voxel centres, as a GPU filters it.
/// Of its own in every source file: some are compiled for processors that others are not.
template <class Real>
static inline glm::vec<4, Real> trilinear_texel(const DistanceVolume& volume, const glm::vec<3, Real>& uvw) {
    std::array<size_t, 3> low{};
    std::array<Real, 3> t{};
    for (int i = 0; i < 3; ++i) {
        const Real place = std::clamp(uvw[i], Real(0), Real(1)) * static_cast<Real>(volume.size[i] - 1);
        low[i] = std::min(static_cast<size_t>(place), static_cast<size_t>(volume.size[i] - 2));
        t[i] = place - static_cast<Real>(low[i]);
    }
    glm::vec<4, Real> sum(0);
    for (size_t corner = 0; corner < 8; ++corner) {
        const size_t dx = corner & 1;
        const size_t dy = corner >> 1 & 1;
        const size_t dz = corner >> 2;
        const Real weight = (dx ? t[0] : 1 - t[0]) * (dy ? t[1] : 1 - t[1]) * (dz ? t[2] : 1 - t[2]);
        const float* value = &volume.texels[volume.texel_index(low[0] + dx, low[1] + dy, low[2] + dz)];
        sum += weight * glm::vec<4, Real>(value[0], value[1], value[2], value[3]);
    }
    return sum;
}

} // namespace anvil

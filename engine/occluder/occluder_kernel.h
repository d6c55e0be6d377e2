// The shared occluder formulas in double.
#pragma once

#include "engine/occluder/distance_volume.h"
#include "engine/occluder/kernel_types.h"

#include <cmath>
#include <memory>

namespace anvil::kernel::f64 {

using namespace glm;
using real4 = dvec4;

/// The functions of shaders/shared/{shape_function,occluder}.h over arrays that outlive it.
struct OccluderKernel {
    const ShapeSegment* segments = nullptr;
    const ShapeNode* nodes = nullptr;
    const Occluder* occluders = nullptr;
    const std::shared_ptr<const DistanceVolume>* volumes = nullptr;
    const uint32_t* field_words = nullptr; ///< of all adaptive fields, one after the other

    real4 volume_texel(uint volume, real3 uvw) const { return volumes[volume]->texel(uvw); }

    uint brick_word(const ShapeNode& node, uint index) const { return field_words[node.words + index]; }

    static bool shape_is(uint kind, uint wanted) { return kind == wanted; }

// NOLINTBEGIN: compiled as GLSL too
#include "shaders/shared/shape_function.h"

#include "shaders/shared/occluder.h"
    // NOLINTEND
};

} // namespace anvil::kernel::f64

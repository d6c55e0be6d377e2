// The shared normals in double.
#pragma once

#include "engine/occluder/kernel_types.h"

#include <cmath>

namespace anvil::kernel::f64 {

using namespace glm;

/// The functions of shaders/shared/normals.h over arrays that outlive it.
struct NormalKernel {
    const real3* ends = nullptr;
    const uint* fan_begin = nullptr;
    const FanCorner* fan_corners = nullptr;

// NOLINTBEGIN: compiled as GLSL too
#include "shaders/shared/normals.h"
    // NOLINTEND
};

} // namespace anvil::kernel::f64

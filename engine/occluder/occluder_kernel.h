// The shared occluder formulas in double.
#pragma once

#include "engine/occluder/distance_volume.h"
#include "engine/occluder/kernel_types.h"
#include "engine/occluder/trilinear.h"

#include <cmath>
#include <memory>

namespace anvil::kernel::f64 {

using namespace glm;
using real4 = dvec4;

#include "engine/occluder/occluder_kernel_of_real.h"

} // namespace anvil::kernel::f64

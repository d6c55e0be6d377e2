// The shared kernel in double: the reference that the GPU is held against.
#pragma once

#include "engine/occluder/occluder_kernel.h"

namespace anvil::kernel::f64 {

#include "engine/deform/deform_kernel_of_real.h"

} // namespace anvil::kernel::f64

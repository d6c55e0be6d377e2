// The kernels' data in C++: f32 is what the GPU reads, f64 what the double reference computes with.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace anvil::kernel {

namespace f32 {
using real = float;
using real3 = glm::vec3;
using uint = uint32_t;
#include "shaders/shared/kernel_types.h"
} // namespace f32

namespace f64 {
using real = double;
using real3 = glm::dvec3;
using uint = uint32_t;
#include "shaders/shared/kernel_types.h"
} // namespace f64

} // namespace anvil::kernel

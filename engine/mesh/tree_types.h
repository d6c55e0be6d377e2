// A search tree's data as kernels read it, in C++.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace anvil::kernel::f32 {

using real = float;
using real3 = glm::vec3;
using uint = uint32_t;
#include "shaders/shared/search_tree.h"

} // namespace anvil::kernel::f32

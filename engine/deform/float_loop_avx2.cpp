// Compiled with AVX2 and FMA where engine/CMakeLists.txt defines ANVIL_AVX2.
#ifdef ANVIL_AVX2

#include "engine/deform/float_loop_of_processor.h"

namespace anvil {

void avx2_float_loop(const FloatArrays& arrays, size_t begin, size_t end) {
    float_loop(arrays, begin, end);
}

} // namespace anvil

#endif

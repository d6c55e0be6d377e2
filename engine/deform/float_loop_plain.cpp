#include "engine/deform/float_loop_of_processor.h"

namespace anvil {

void plain_float_loop(const FloatArrays& arrays, size_t begin, size_t end) {
    float_loop(arrays, begin, end);
}

} // namespace anvil

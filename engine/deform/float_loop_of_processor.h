// The body of float_loop_plain.cpp and float_loop_avx2.cpp, which are compiled for different processors. All
// code of ours is in an unnamed namespace and the whole loop is one function, so that a linker cannot put
// what one processor understands where another one runs.
#include "engine/deform/float_loop.h"
#include "engine/occluder/trilinear.h"

#include <cmath>
#include <memory>

namespace anvil {

namespace kernel::f32 {

namespace {

using namespace glm;
using real4 = vec4;

#include "engine/occluder/occluder_kernel_of_real.h"

#include "engine/deform/deform_kernel_of_real.h"

} // namespace

} // namespace kernel::f32

__attribute__((flatten)) static inline void float_loop(const FloatArrays& arrays, size_t begin, size_t end) {
    kernel::f32::DeformKernel kernel;
    kernel.segments = arrays.segments.data();
    kernel.nodes = arrays.nodes.data();
    kernel.occluders = arrays.occluders.data();
    kernel.volumes = arrays.volumes.data();
    kernel.field_words = arrays.field_words;
    kernel.params = arrays.params;
    kernel.points = arrays.points.data();
    kernel.fields = arrays.fields.data();
    kernel.shapes = arrays.shapes.data();
    kernel.targets = arrays.targets.data();
    kernel.poses = arrays.poses.data();
    kernel.start_distances = arrays.start_distances.data();
    kernel::f32::VertexResult* const results = arrays.results.data();
    for (size_t i = begin; i < end; ++i) {
        results[i] = kernel.deformed(static_cast<uint32_t>(i));
    }
}

} // namespace anvil

// The shared kernel over C++ arrays. Included after engine/occluder/occluder_kernel_of_real.h, in the same
// namespace.

#define INOUT(type) type&
#define PRECISE

#include "shaders/shared/looks.h"

/// The functions of shaders/shared/{path,contact,walk}.h over arrays that outlive it.
struct DeformKernel : OccluderKernel {
    KernelParams params{};
    const real3* points = nullptr;
    const real* fields = nullptr;
    const CurveRange* shapes = nullptr;
    const real3* targets = nullptr;
    const Pose* poses = nullptr;
    const real* start_distances = nullptr;

    const Occluder& occluder_at(uint k) const { return occluders[k]; }
    real field_at(uint j, uint i) const { return fields[j * params.field_stride + i]; }
    real handle_weight(uint j, real t) { return curve_value(shapes[j], t); }
    real3 target_at(uint s, uint j) const { return targets[(s - 1) * params.handle_count + j]; }

// NOLINTBEGIN: compiled as GLSL too
#include "shaders/shared/path.h"

#include "shaders/shared/contact.h"

#include "shaders/shared/course.h"

#include "shaders/shared/walk.h"
    // NOLINTEND
};

#undef INOUT
#undef PRECISE

// The shared occluder formulas over C++ arrays. Included within a namespace that has real, real3, real4, uint
// and the structs of shaders/shared/kernel_types.h for them.

/// The functions of shaders/shared/{shape_function,occluder}.h over arrays that outlive it.
struct OccluderKernel {
    const ShapeSegment* segments = nullptr;
    const ShapeNode* nodes = nullptr;
    const Occluder* occluders = nullptr;
    const std::shared_ptr<const DistanceVolume>* volumes = nullptr;
    const uint32_t* field_words = nullptr; ///< of all adaptive fields, one after the other

    real4 volume_texel(uint volume, real3 uvw) const { return trilinear_texel(*volumes[volume], uvw); }

    uint brick_word(const ShapeNode& node, uint index) const { return field_words[node.words + index]; }

    static bool shape_is(uint kind, uint wanted) { return kind == wanted; }

// NOLINTBEGIN: compiled as GLSL too
#include "shaders/shared/shape_function.h"

#include "shaders/shared/occluder.h"
    // NOLINTEND
};

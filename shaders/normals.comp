#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// One vertex's normal an invocation, after deform.comp has moved the vertices of a region.

layout(local_size_x = 64) in; // normals_workgroup in engine/gpu/normals_pass.h

#define real float
#define real3 vec3

#include "shared/invocation.glsl"
#include "shared/kernel_types.h"

layout(push_constant, scalar) uniform Parameters {
    uint count;
    uint first; // place of the first one in `ends` and `normals`
};

layout(binding = 0, scalar) readonly buffer Ends { vec3 ends[]; };
layout(binding = 1, scalar) readonly buffer FanBegin { uint fan_begin[]; };
layout(binding = 2, scalar) readonly buffer FanCorners { FanCorner fan_corners[]; };
layout(binding = 3, scalar) writeonly buffer Normals { vec3 normals[]; };

#include "shared/normals.h"

void main() {
    uint i = invocation_index();
    if (i < count) {
        normals[first + i] = fan_normal(i, first + i);
    }
}

#version 460
// One edit's displacement of one point an invocation; the work itself is shared/contact.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in; // deform_workgroup in engine/gpu/deform_pipeline.h

#define real float
#define real3 vec3
#define real4 vec4
#define INOUT(type) inout type
#define PRECISE precise

#include "shared/invocation.glsl"
#include "shared/kernel_types.h"

layout(push_constant, scalar) uniform Parameters { KernelParams params; };

layout(binding = 0, scalar) readonly buffer Points { vec3 points[]; };
layout(binding = 1, scalar) readonly buffer Fields { float fields[]; };
layout(binding = 2, scalar) readonly buffer StartDistances { float start_distances[]; };
layout(binding = 3, scalar) readonly buffer Shapes { CurveRange shapes[]; };
layout(binding = 4, scalar) readonly buffer Segments { ShapeSegment segments[]; };
layout(binding = 5, scalar) readonly buffer Occluders { Occluder occluders[]; };
layout(binding = 6, scalar) readonly buffer Nodes { ShapeNode nodes[]; };
layout(binding = 7, scalar) readonly buffer Targets { vec3 targets[]; };
layout(binding = 8, scalar) writeonly buffer Results { VertexResult results[]; };
// Single bindings, not an array: its index would have to be the same in all invocations.
layout(binding = 9) uniform sampler3D volume_0;
layout(binding = 10) uniform sampler3D volume_1;
layout(binding = 11) uniform sampler3D volume_2;
layout(binding = 12) uniform sampler3D volume_3;
layout(binding = 13) uniform sampler3D volume_4;
layout(binding = 14) uniform sampler3D volume_5;
layout(binding = 15) uniform sampler3D volume_6;
layout(binding = 16) uniform sampler3D volume_7;

/// Between the outermost voxel centres, as the field's own coordinates run.
vec3 texture_place(ivec3 size, vec3 uvw) { return (uvw * vec3(size - 1) + 0.5) / vec3(size); }

#define SAMPLE(volume_name) textureLod(volume_name, texture_place(textureSize(volume_name, 0), uvw), 0.0)

vec4 volume_texel(uint volume, vec3 uvw) {
    switch (volume) {
    case 0u:
        return SAMPLE(volume_0);
    case 1u:
        return SAMPLE(volume_1);
    case 2u:
        return SAMPLE(volume_2);
    case 3u:
        return SAMPLE(volume_3);
    case 4u:
        return SAMPLE(volume_4);
    case 5u:
        return SAMPLE(volume_5);
    case 6u:
        return SAMPLE(volume_6);
    default:
        return SAMPLE(volume_7);
    }
}

#include "shared/shape_function.h"
#include "shared/occluder.h"
#include "shared/contact.h"

void main() {
    uint i = invocation_index();
    if (i < params.point_count) {
        results[i] = deformed(i);
    }
}

// One edit's displacement of one point an invocation; the work itself is shared/walk.h. What an edit does not
// need is compiled out: drivers inline everything, and lavapipe runs both sides of every branch. With FEW_OCCLUDERS
// the variant knows their number and kinds, so that loops unroll and occluders stay in registers. With
// FIELD_WINDOWS, distances come from uniform buffers, as many points a dispatch as these hold: lavapipe reads
// those ten times as fast as storage buffers. With WIDE_STORES, which knows no occluders, two points are stored
// at once as three integers of 64 bits: lavapipe stores number by number, lane by lane.

layout(local_size_x = 64) in; // deform_workgroup in engine/gpu/deform_pipeline.h

#define real float
#define real3 vec3
#define real4 vec4
#define INOUT(type) inout type
#define PRECISE precise

#include "shared/invocation.glsl"
#include "shared/kernel_types.h"

#ifdef FIELD_WINDOWS
const uint field_window_floats = 16384u; // field_window_bytes in engine/gpu/deform_pipeline.h
#endif

layout(push_constant, scalar) uniform Parameters { KernelParams pushed; };
KernelParams params; // `pushed`, with what this variant of the pipeline does not do set to zero

layout(binding = 0, scalar) readonly buffer Points { vec3 points[]; };
layout(binding = 1, scalar) readonly buffer Fields { float fields[]; };
layout(binding = 2, scalar) readonly buffer StartDistances { float start_distances[]; };
layout(binding = 3, scalar) readonly buffer Shapes { CurveRange shapes[]; };
layout(binding = 4, scalar) readonly buffer Segments { ShapeSegment segments[]; };
#ifdef FEW_OCCLUDERS
layout(constant_id = 7) const uint occluder_count = 1u;
layout(constant_id = 8) const uint node_count = 1u;
layout(constant_id = 9) const uint node_counts = 1u; // of each occluder, 4 bits each
layout(constant_id = 10) const uint kinds = 0u;      // of each node, likewise
layout(constant_id = 11) const uint influences = 0u; // of each occluder, likewise
layout(binding = 5, scalar) readonly buffer Occluders { Occluder stored_occluders[]; };
layout(binding = 6, scalar) readonly buffer Nodes { ShapeNode stored_nodes[]; };
Occluder occluders[occluder_count];
ShapeNode nodes[node_count];
#else
layout(binding = 5, scalar) readonly buffer Occluders { Occluder occluders[]; };
layout(binding = 6, scalar) readonly buffer Nodes { ShapeNode nodes[]; };
#endif
layout(binding = 7, scalar) readonly buffer Targets { vec3 targets[]; };
layout(binding = 8, scalar) writeonly buffer Displacements { vec3 displacements[]; };
// Single bindings, not an array: its index would have to be the same in all invocations.
layout(binding = 9) uniform sampler3D volume_0;
layout(binding = 10) uniform sampler3D volume_1;
layout(binding = 11) uniform sampler3D volume_2;
layout(binding = 12) uniform sampler3D volume_3;
layout(binding = 13) uniform sampler3D volume_4;
layout(binding = 14) uniform sampler3D volume_5;
layout(binding = 15) uniform sampler3D volume_6;
layout(binding = 16) uniform sampler3D volume_7;
layout(binding = 17, scalar) readonly buffer Poses { Pose poses[]; };
layout(binding = 18, scalar) readonly buffer FieldWords { uint field_words[]; };
layout(binding = 19, scalar) writeonly buffer Ends { vec3 ends[]; };
layout(binding = 20, scalar) writeonly buffer Counts { uvec3 counts[]; }; // steps, samples, flags; past occluders
#ifdef FIELD_WINDOWS
layout(binding = 21, scalar) uniform FieldWindow0 { float field_window_0[field_window_floats]; };
layout(binding = 22, scalar) uniform FieldWindow1 { float field_window_1[field_window_floats]; };
layout(binding = 23, scalar) uniform FieldWindow2 { float field_window_2[field_window_floats]; };
layout(binding = 24, scalar) uniform FieldWindow3 { float field_window_3[field_window_floats]; };
layout(binding = 25, scalar) uniform FieldWindow4 { float field_window_4[field_window_floats]; };
layout(binding = 26, scalar) uniform FieldWindow5 { float field_window_5[field_window_floats]; };
layout(binding = 27, scalar) uniform FieldWindow6 { float field_window_6[field_window_floats]; };
layout(binding = 28, scalar) uniform FieldWindow7 { float field_window_7[field_window_floats]; };
#endif

#ifdef WIDE_STORES
layout(binding = 8, scalar) writeonly buffer DisplacementPairs { u64vec3 displacement_pairs[]; };
layout(binding = 19, scalar) writeonly buffer EndPairs { u64vec3 end_pairs[]; };
#endif

// DeformVariant of engine/gpu/deform_pipeline.h, in this order.
layout(constant_id = 0) const uint has_occluders = 1u;
layout(constant_id = 1) const uint volume_count = 8u;
layout(constant_id = 2) const uint paper = 1u;
layout(constant_id = 3) const uint motion = 0u;
layout(constant_id = 4) const uint steps = 0u;
layout(constant_id = 5) const uint one_sample = 0u;
layout(constant_id = 6) const uint shape_kinds = 0u; // bit SHAPE_...: there is a node of this kind
layout(constant_id = 12) const uint moving = 0u;
layout(constant_id = 13) const uint writes_ends = 0u;
layout(constant_id = 14) const uint points_each = 1u;   // worked by an invocation, one after the other
layout(constant_id = 15) const uint kept_handles = 0u;  // 0: shapes and targets are read where they are needed
layout(constant_id = 16) const uint segments_each = 1u; // of each kept handle's shape
layout(constant_id = 17) const uint handles_each = 1u;  // in a window of distances
ShapeSegment kept_segments[(kept_handles + 1u) * segments_each];
vec3 kept_targets[kept_handles + 1u];

/// Where there are few, by selection: an index that is not a constant would put them all into memory.
Occluder occluder_at(uint k) {
#ifdef FEW_OCCLUDERS
    Occluder occluder = occluders[0];
    for (uint other = 1u; other < occluder_count; ++other) {
        if (k == other) {
            occluder = occluders[other];
        }
    }
    return occluder;
#else
    return occluders[k];
#endif
}

bool shape_is(uint kind, uint wanted) { return (shape_kinds & (1u << wanted)) != 0u && kind == wanted; }

/// Between the outermost voxel centres, as the field's own coordinates run.
vec3 texture_place(ivec3 size, vec3 uvw) { return (uvw * vec3(size - 1) + 0.5) / vec3(size); }

#define SAMPLE_IF(number, name)                                                                                        \
    if (volume_count > number && volume == number) {                                                                   \
        return textureLod(name, texture_place(textureSize(name, 0), uvw), 0.0);                                        \
    }

vec4 volume_texel(uint volume, vec3 uvw) {
    SAMPLE_IF(0u, volume_0)
    SAMPLE_IF(1u, volume_1)
    SAMPLE_IF(2u, volume_2)
    SAMPLE_IF(3u, volume_3)
    SAMPLE_IF(4u, volume_4)
    SAMPLE_IF(5u, volume_5)
    SAMPLE_IF(6u, volume_6)
    SAMPLE_IF(7u, volume_7)
    return vec4(0.0);
}

uint brick_word(ShapeNode node, uint index) { return field_words[node.words + index]; }

#include "shared/shape_function.h"
#include "shared/occluder.h"

vec3 target_at(uint s, uint j) {
    return kept_handles != 0u ? kept_targets[j] : targets[(s - 1u) * params.handle_count + j];
}

#ifdef FIELD_WINDOWS
#define FIELD_IF(number, name)                                                                                         \
    if (window == number) {                                                                                            \
        return name[place];                                                                                            \
    }

/// Once loops are unrolled, of one window each.
float field_at(uint j, uint i) {
    uint window = j / handles_each;
    uint place = j % handles_each * params.field_stride + i;
    FIELD_IF(0u, field_window_0)
    FIELD_IF(1u, field_window_1)
    FIELD_IF(2u, field_window_2)
    FIELD_IF(3u, field_window_3)
    FIELD_IF(4u, field_window_4)
    FIELD_IF(5u, field_window_5)
    FIELD_IF(6u, field_window_6)
    return field_window_7[place];
}
#else
float field_at(uint j, uint i) { return fields[j * params.field_stride + i]; }
#endif

/// Of a kept shape by selection, as with occluder_at().
float handle_weight(uint j, float t) {
    if (kept_handles == 0u) {
        return curve_value(shapes[j], t);
    }
    ShapeSegment segment = kept_segments[j * segments_each];
    for (uint s = 1u; s < segments_each; ++s) {
        ShapeSegment next = kept_segments[j * segments_each + s];
        if (next.begin <= t) {
            segment = next;
        }
    }
    return t <= 1.0 ? segment_value(segment, t) : 0.0;
}

#include "shared/path.h"
#include "shared/contact.h"
#include "shared/course.h"
#include "shared/looks.h"
#include "shared/walk.h"

/// What the variant knows, as constants.
void prepare() {
    params = pushed;
    params.occluder_count = has_occluders != 0u ? params.occluder_count : 0u;
    params.paper = paper;
    params.moving = moving;
    params.motion = motion;
    params.steps = steps;
    params.sample_count = one_sample != 0u ? 1u : params.sample_count;
    if (kept_handles != 0u) {
        params.handle_count = kept_handles;
    }
    for (uint j = 0u; j < kept_handles; ++j) {
        kept_targets[j] = targets[j];
        uint first = shapes[j].first;
        for (uint s = 0u; s < segments_each; ++s) {
            kept_segments[j * segments_each + s] = segments[first + s];
        }
    }
#ifdef FEW_OCCLUDERS
    params.occluder_count = occluder_count;
    uint first_node = 0u;
    for (uint k = 0u; k < occluder_count; ++k) {
        occluders[k] = stored_occluders[k];
        occluders[k].first_node = first_node;
        occluders[k].node_count = (node_counts >> (4u * k)) & 15u;
        occluders[k].influence = (influences >> (4u * k)) & 15u;
        first_node += occluders[k].node_count;
    }
    for (uint n = 0u; n < node_count; ++n) {
        nodes[n] = stored_nodes[n];
        nodes[n].kind = (kinds >> (4u * n)) & 15u;
    }
#endif
}

void write_result(uint i, VertexResult result) {
    displacements[i] = result.displacement;
    if (has_occluders != 0u) {
        counts[i] = uvec3(result.steps, result.samples, result.flags);
    }
    if (writes_ends != 0u) {
        ends[i] = points[i] + result.displacement;
    }
}

#ifdef WIDE_STORES

u64vec3 pair_of(vec3 a, vec3 b) {
    uvec3 x = floatBitsToUint(a);
    uvec3 y = floatBitsToUint(b);
    return u64vec3(pack64(x.xy), pack64(uvec2(x.z, y.x)), pack64(y.yz));
}

vec3 displacement_of(uint i) {
    VertexResult result;
    unhindered(i, result);
    return result.displacement;
}

/// Points i and i + 1, i even.
void work_pair(uint i) {
    vec3 a = displacement_of(i);
    vec3 b = displacement_of(i + 1u);
    displacement_pairs[i / 2u] = pair_of(a, b);
    if (writes_ends != 0u) {
        end_pairs[i / 2u] = pair_of(points[i] + a, points[i + 1u] + b);
    }
}

void main() {
    prepare();
    uint lane = gl_LocalInvocationID.x;
    uint first = (invocation_index() - lane) * points_each + 2u * lane;
    for (uint p = 0u; p < points_each; p += 2u) {
        uint i = first + p * gl_WorkGroupSize.x;
        if (i + 1u < params.point_count) {
            work_pair(i);
        }
    }
    uint last = params.point_count - 1u; // without a partner where the count is odd
    uint past = last - first;
    if (last % 2u == 0u && last >= first && past % (2u * gl_WorkGroupSize.x) == 0u &&
        past < points_each * gl_WorkGroupSize.x) {
        VertexResult result;
        unhindered(last, result);
        write_result(last, result);
    }
}

#else

/// First what no occluder can act on, then the others of all points together: devices that work invocations side
/// by side go through a walk where a single one of them has to, lavapipe even where none has.
void main() {
    prepare();
    uint lane = gl_LocalInvocationID.x;
    uint first = (invocation_index() - lane) * points_each + lane;
    uint waiting = 0u; // bit p: of the p-th point
    for (uint p = 0u; p < points_each; ++p) {
        uint i = first + p * gl_WorkGroupSize.x;
        if (i < params.point_count) {
            VertexResult result;
            if (unhindered(i, result)) {
                write_result(i, result);
            } else {
                waiting |= 1u << p;
            }
        }
    }
    while (has_occluders != 0u && waiting != 0u) {
        uint i = first + uint(findLSB(waiting)) * gl_WorkGroupSize.x;
        waiting &= waiting - 1u;
        write_result(i, hindered(i));
    }
}

#endif

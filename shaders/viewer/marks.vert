#version 460
#extension GL_GOOGLE_include_directive : require
// Two triangles around each mark, wide enough for its soft rim.
#include "mark.h"

layout(push_constant) uniform Block {
    vec2 window; // pixels
};
layout(std430, binding = 0) readonly buffer Marks {
    Mark marks[];
};

layout(location = 0) out flat uint number;
layout(location = 1) out float facet_depth;

const vec2 corners[6] = {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1)};

void main() {
    number = uint(gl_VertexIndex) / 6u;
    const uint corner = uint(gl_VertexIndex) % 6u;
    const Mark mark = marks[number];
    vec2 place = mark.a.xy;
    facet_depth = mark.a.z;
    if (mark.kind == MARK_FACET) {
        // The second triangle is none: its corners are one.
        place = corner == 1u ? mark.b.xy : corner == 2u ? mark.c.xy : mark.a.xy;
        facet_depth = corner == 1u ? mark.b.z : corner == 2u ? mark.c.z : mark.a.z;
    } else {
        const vec2 other = mark.kind == MARK_LINE ? mark.b.xy : mark.a.xy;
        const float apart = length(other - place);
        const vec2 along = apart > 0.0 ? (other - place) / apart : vec2(1, 0);
        const float room = mark.a.w + mark.b.w + 1.0;
        const vec2 end = corners[corner].x < 0.0 ? place : other;
        place = end + room * (corners[corner].x * along + corners[corner].y * vec2(-along.y, along.x));
    }
    gl_Position = vec4(2.0 * place / window - 1.0, 0.0, 1.0);
}

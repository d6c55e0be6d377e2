#version 460
#extension GL_GOOGLE_include_directive : require
// Marks as they are shown, faint where the surface hides them.
#include "mark.h"

layout(std430, binding = 0) readonly buffer Marks {
    Mark marks[];
};
layout(binding = 1) uniform sampler2D depths; // of the picture below

layout(location = 0) in flat uint number;
layout(location = 1) in float facet_depth;

layout(location = 0) out vec4 picture;

const float hidden_opacity = 0.3;

/// A place on the surface itself is seen; beside it the surface may be as much nearer as it slopes, so that
/// the farthest of the pixels around decides.
bool hidden(vec2 place, float depth) {
    const ivec2 last = textureSize(depths, 0) - 1;
    float farthest = 0.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            const ivec2 at = clamp(ivec2(floor(place)) + ivec2(x, y), ivec2(0), last);
            farthest = max(farthest, texelFetch(depths, at, 0).r);
        }
    }
    return depth > farthest;
}

void main() {
    const Mark mark = marks[number];
    const vec2 pixel = gl_FragCoord.xy;
    vec2 place = mark.a.xy;
    float depth = mark.a.z;
    float cover = 1.0;
    if (mark.kind == MARK_LINE) {
        const vec2 way = mark.b.xy - mark.a.xy;
        const float square = dot(way, way);
        const float s = square > 0.0 ? clamp(dot(pixel - place, way) / square, 0.0, 1.0) : 0.0;
        place += s * way;
        depth = mix(depth, mark.b.z, s);
        cover = mark.a.w + 0.5 - length(pixel - place);
    } else if (mark.kind == MARK_RING) {
        cover = mark.b.w + 0.5 - abs(length(pixel - place) - mark.a.w);
    } else if (mark.kind == MARK_SQUARE) {
        const vec2 away = abs(pixel - place);
        cover = mark.a.w + 0.5 - max(away.x, away.y);
    } else {
        place = pixel;
        depth = facet_depth;
    }
    const vec4 ink = unpackUnorm4x8(mark.colour);
    const float seen = hidden(place, depth) ? hidden_opacity : 1.0;
    picture = vec4(ink.rgb, ink.a * clamp(cover, 0.0, 1.0) * seen);
}

#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "viewer/mesh_parameters.h"
#include "viewer/lights.glsl"

layout(push_constant, scalar) uniform Block { MeshParameters parameters; };

layout(location = 0) in vec3 view_position;
layout(location = 1) in vec3 view_normal;
layout(location = 2) in vec2 mark;
layout(location = 3) in float chosen;

layout(location = 0) out vec4 picture;

bool has(uint flag) { return (parameters.flags & flag) != 0u; }

/// What is selected is hatched in light and dark: on every colour of the region, to every eye.
vec3 hatched(vec3 base) {
    float stripe = smoothstep(0.30, 0.42, abs(fract((gl_FragCoord.x + gl_FragCoord.y) / 7.0) - 0.5));
    vec3 marked = mix(vec3(0.30, 0.03, 0.32), vec3(0.95, 0.80, 0.92), stripe);
    return mix(base, mix(base, marked, 0.8), smoothstep(0.25, 0.75, chosen));
}

vec3 base_colour() {
    vec3 base = parameters.colour.rgb;
    if (has(MESH_TINTED)) {
        base = weight_colour(base, mark.x);
    }
    if (has(MESH_CONTOURS) && mark.y >= 0.0 && mark.y < parameters.contour_end) {
        base = mix(base, vec3(0.012), 0.7 * contour_cover(mark.y / parameters.contour_spacing));
    }
    return chosen > 0.0 ? hatched(base) : base;
}

void main() {
    if (has(MESH_LINES)) {
        picture = parameters.colour;
        return;
    }
    vec3 to_eye = parameters.orthographic > 0.5 ? vec3(0.0, 0.0, 1.0) : normalize(-view_position);
    bool smooth_normal = !has(MESH_FLAT) && dot(view_normal, view_normal) > 1e-12;
    vec3 face_normal = cross(dFdx(view_position), dFdy(view_position));
    vec3 n = normalize(smooth_normal ? view_normal : face_normal);
    if (smooth_normal ? !gl_FrontFacing : dot(n, to_eye) < 0.0) {
        n = -n;
    }
    float alpha = parameters.colour.a;
    vec3 base = base_colour();
    bool back = !gl_FrontFacing && !has(MESH_PLAIN_BACK);
    if (back && alpha >= 1.0) {
        base = vec3(0.42, 0.16, 0.20); // the inside of an open surface
    }
    vec3 light = lit(parameters.flags, n, to_eye, base);
    if (alpha < 1.0) {
        float grazing = 1.0 - abs(dot(n, to_eye));
        alpha = mix(alpha, 1.0, 0.75 * grazing * grazing * grazing);
        alpha = gl_FrontFacing ? alpha : 0.6 * alpha;
        picture = vec4(light * alpha + (gl_FrontFacing ? glass_highlight(n, to_eye) : 0.0), alpha);
        return;
    }
    picture = vec4(light, 1.0);
}

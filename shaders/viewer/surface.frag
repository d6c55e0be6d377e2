#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "viewer/surface_parameters.h"
#include "viewer/studio.glsl"

layout(push_constant, scalar) uniform Block { SurfaceParameters parameters; };

layout(location = 0) in vec3 view_position;
layout(location = 1) in vec3 view_normal;
layout(location = 2) in float vertex_tint;
layout(location = 3) in vec3 vertex_colour;

layout(location = 0) out vec4 picture;

void main() {
    vec3 to_eye = parameters.orthographic > 0.5 ? vec3(0.0, 0.0, 1.0) : normalize(-view_position);
    // Where a vertex has no normal, the triangle's own is the best guess.
    vec3 flat_normal = cross(dFdx(view_position), dFdy(view_position));
    vec3 n = dot(view_normal, view_normal) > 1e-12 ? view_normal : flat_normal;
    n = normalize(gl_FrontFacing ? n : -n);
    vec3 base;
    if (parameters.contour_spacing > 0.0) {
        base = length_colour(vertex_tint / parameters.contour_end);
        base = mix(base, vec3(0.012), 0.85 * contour_cover(vertex_tint / parameters.contour_spacing));
    } else {
        base = tinted(vertex_colour, vertex_tint);
    }
    vec3 light = studio_light(n, to_eye, base);
    if (!gl_FrontFacing && parameters.opacity >= 1.0) {
        light *= 0.6; // the inside of an open surface
    }
    float alpha = parameters.opacity;
    if (alpha < 1.0) {
        // Like thin glass: clearer where one looks straight through.
        float grazing = 1.0 - abs(dot(n, to_eye));
        alpha = mix(alpha, 1.0, 0.75 * grazing * grazing * grazing);
        alpha = gl_FrontFacing ? alpha : 0.6 * alpha;
        picture = vec4(light * alpha + (gl_FrontFacing ? glass_highlight(n, to_eye) : 0.0), alpha);
        return;
    }
    picture = vec4(light, 1.0);
}

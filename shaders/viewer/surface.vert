#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "viewer/surface_parameters.h"

layout(push_constant, scalar) uniform Block { SurfaceParameters parameters; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float tint;
layout(location = 3) in vec4 colour;

layout(location = 0) out vec3 view_position;
layout(location = 1) out vec3 view_normal;
layout(location = 2) out float vertex_tint;
layout(location = 3) out vec3 vertex_colour;

vec3 linear_of(vec3 srgb) { return mix(srgb / 12.92, pow((srgb + 0.055) / 1.055, vec3(2.4)), step(0.04045, srgb)); }

void main() {
    view_position = position;
    view_normal = normal;
    vertex_tint = tint;
    vertex_colour = linear_of(colour.rgb);
    gl_Position = parameters.projection * vec4(position, 1.0);
}

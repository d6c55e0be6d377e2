// Push constants of viewer/surface.{vert,frag}; the same text for C++ (with vec4, mat4 named) and GLSL.
#ifndef ANVIL_SURFACE_PARAMETERS_H
#define ANVIL_SURFACE_PARAMETERS_H

struct SurfaceParameters {
    mat4 projection;
    float opacity;
    float orthographic;    // 1: parallel view, 0: eye at the origin of view space
    float contour_spacing; // > 0: the tint is a length, coloured up to contour_end with a line at every
                           // multiple
    float contour_end;
};

#endif

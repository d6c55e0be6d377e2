// Other lights than the studio: what shows form alone. View space, linear colours.
#ifndef ANVIL_LIGHTS_GLSL
#define ANVIL_LIGHTS_GLSL
#include "viewer/mesh_parameters.h"
#include "viewer/studio.glsl"

/// From the base colour (0) through dark blue and grey to yellow (1): ever lighter, so that every kind of colour
/// vision tells weights apart, and none looks like the base.
vec3 weight_colour(vec3 base, float weight) {
    const vec3 colours[5] = vec3[](vec3(0.000, 0.014, 0.074), vec3(0.054, 0.076, 0.150), vec3(0.205, 0.202, 0.188),
                                   vec3(0.497, 0.429, 0.165), vec3(1.000, 0.823, 0.061));
    float t = 4.0 * clamp(weight, 0.0, 1.0);
    int below = min(int(t), 3);
    return mix(base, mix(colours[below], colours[below + 1], t - float(below)), 0.85 * smoothstep(0.0, 0.06, weight));
}

/// Matte, lit from the eye: as bright as it faces the eye, with no highlight that could be taken for form.
vec3 clay_light(vec3 n, vec3 to_eye, vec3 base) {
    float facing = max(0.0, dot(n, to_eye));
    float from_above = 0.5 + 0.5 * n.y;
    return base * (0.16 + 0.86 * pow(facing, 0.8)) * mix(0.82, 1.12, from_above);
}

/// The normal as the eye sees it: upright where the surface faces it, also near the window's rim.
vec2 seen_direction(vec3 n, vec3 to_eye) {
    vec3 side = normalize(cross(vec3(0.0, 1.0, 0.0), to_eye));
    return vec2(dot(n, side), dot(n, cross(to_eye, side)));
}

/// Polished metal in a room with a window, a floor and a dark wall: bends show as bends of what it mirrors.
vec3 metal_light(vec3 n, vec3 to_eye, vec3 base) {
    vec2 seen = seen_direction(n, to_eye);
    float height = seen.y;
    vec3 room = mix(vec3(0.05, 0.045, 0.04), vec3(0.16, 0.17, 0.19), smoothstep(-0.9, -0.15, height));
    room = mix(room, vec3(0.03, 0.035, 0.045), smoothstep(-0.12, 0.10, height));
    room = mix(room, vec3(0.62, 0.68, 0.76), smoothstep(0.15, 0.75, height));
    float lamp = smoothstep(0.34, 0.24, length(seen - vec2(-0.38, 0.52)));
    room += vec3(0.9, 0.86, 0.78) * lamp;
    float edge = pow(1.0 - max(0.0, dot(n, to_eye)), 4.0);
    vec3 tint = mix(base * 1.7 + 0.12, vec3(1.0), 0.35);
    return room * tint + 0.30 * edge * vec3(0.75, 0.85, 1.0) + 0.10 * base;
}

/// Parallel lamps mirrored by the surface: where it is smooth to the second order their edges have no kinks.
vec3 stripes_light(vec3 n, vec3 to_eye, vec3 base) {
    float around = 9.0 * asin(clamp(seen_direction(n, to_eye).x, -1.0, 1.0));
    float width = max(fwidth(around), 1e-6);
    float wave = abs(fract(around) - 0.5);
    float stripe = smoothstep(0.25 - width, 0.25 + width, wave);
    stripe = mix(stripe, 0.5, smoothstep(0.3, 0.8, width));
    return clay_light(n, to_eye, mix(base, vec3(0.75), 0.35)) * mix(0.14, 1.0, stripe);
}

vec3 lit(uint flags, vec3 n, vec3 to_eye, vec3 base) {
    uint lights = (flags / MESH_LIGHTS) & 3u;
    if (lights == 1u) {
        return clay_light(n, to_eye, base);
    }
    if (lights == 2u) {
        return metal_light(n, to_eye, base);
    }
    if (lights == 3u) {
        return stripes_light(n, to_eye, base);
    }
    return studio_light(n, to_eye, base);
}

#endif

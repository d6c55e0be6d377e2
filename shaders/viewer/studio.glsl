// A neutral studio, fixed to the camera: view space, linear colours.
#ifndef ANVIL_STUDIO_GLSL
#define ANVIL_STUDIO_GLSL

/// From the base colour (0) over blue to orange (1): told apart by every kind of colour vision.
vec3 tinted(vec3 base, float tint) {
    float t = clamp(tint, 0.0, 1.0);
    const vec3 blue = vec3(0.075, 0.235, 0.585);
    const vec3 pale = vec3(0.60, 0.60, 0.58);
    const vec3 orange = vec3(0.84, 0.33, 0.07);
    vec3 ramp = t < 0.55 ? mix(blue, pale, smoothstep(0.12, 0.55, t)) : mix(pale, orange, smoothstep(0.55, 1.0, t));
    return mix(base, ramp, 0.78 * smoothstep(0.0, 0.14, t));
}

/// Lengths from yellow (0) over grey to blue (1): ever darker, so that every kind of colour vision tells them
/// apart; light enough for dark lines.
vec3 length_colour(float t) {
    const vec3 near = vec3(0.96, 0.76, 0.16);
    const vec3 middle = vec3(0.50, 0.50, 0.43);
    const vec3 far = vec3(0.055, 0.17, 0.52);
    t = clamp(t, 0.0, 1.0);
    return t < 0.5 ? mix(near, middle, 2.0 * t) : mix(middle, far, 2.0 * t - 1.0);
}

/// How much of a pixel the line at the nearest multiple of 1 covers; every fifth is wider, 0 has none. Lines
/// fade where they come closer than a few pixels.
float contour_cover(float value) {
    float a_pixel = max(length(vec2(dFdx(value), dFdy(value))), 1e-12);
    float nearest = floor(value + 0.5);
    float half_width = mod(nearest, 5.0) < 0.5 ? 1.3 : 0.7; // pixels
    float away = abs(value - nearest) / a_pixel;
    float cover = 1.0 - smoothstep(half_width - 0.5, half_width + 0.5, away);
    return nearest < 0.5 ? 0.0 : cover * (1.0 - smoothstep(0.15, 0.4, a_pixel));
}

const vec3 studio_key = normalize(vec3(-0.65, 0.70, 0.50));

/// What glass mirrors of the lights, whatever its opacity.
float glass_highlight(vec3 n, vec3 to_eye) {
    float towards = max(0.0, dot(n, normalize(studio_key + to_eye)));
    return 0.55 * smoothstep(0.985, 0.998, towards) + 0.10 * pow(towards, 40.0);
}

vec3 studio_light(vec3 n, vec3 to_eye, vec3 base) {
    const vec3 key = studio_key;
    const vec3 fill = normalize(vec3(0.90, -0.10, 0.35));
    const vec3 rim = normalize(vec3(0.45, 0.45, -0.77));
    vec3 sky = mix(vec3(0.10, 0.085, 0.08), vec3(0.25, 0.28, 0.33), 0.5 + 0.5 * n.y);
    float wrapped = max(0.0, (dot(n, key) + 0.12) / 1.12);
    vec3 light = sky + vec3(1.02, 0.97, 0.88) * wrapped + vec3(0.10, 0.12, 0.16) * max(0.0, dot(n, fill));
    // A little light under the skin: shadows of clay are warm, not grey.
    light += 0.05 * vec3(1.0, 0.45, 0.25) * smoothstep(-0.55, 0.1, dot(n, key)) * (1.0 - wrapped);
    vec3 colour = base * light;
    vec3 half_way = normalize(key + to_eye);
    // Powers by products: where a processor draws, pow() costs as much as all the rest.
    float towards = max(0.0, dot(n, half_way));
    float to4 = towards * towards * towards * towards;
    float to28 = to4 * to4 * to4 * to4 * to4 * to4 * to4;
    float to8 = to4 * to4;
    float shine = 0.05 * to28 * (1.0 + to28 * to28 * to28 * to8); // the powers 28 and 120
    float away = 1.0 - max(0.0, dot(n, to_eye));
    float edge = away * away * away * sqrt(max(away, 0.0));
    colour += shine * vec3(1.0, 0.98, 0.94);
    colour += edge * (0.015 + 0.42 * max(0.0, dot(n, rim))) * vec3(0.80, 0.88, 1.0);
    // Facing away from the eye a surface sees less of the studio.
    return colour * mix(0.72, 1.0, smoothstep(0.0, 0.6, dot(n, to_eye)));
}

#endif

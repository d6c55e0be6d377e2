#version 460
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 picture;

void main() {
    vec3 colour = mix(vec3(0.90, 0.91, 0.93), vec3(0.66, 0.68, 0.71), place.y);
    vec2 off = place - vec2(0.5, 0.42);
    colour *= 1.0 - 0.28 * dot(off, off);
    // Less than a step of eight bits: breaks up the bands of a slow gradient.
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    picture = vec4(colour + (noise - 0.5) / 200.0, 1.0);
}

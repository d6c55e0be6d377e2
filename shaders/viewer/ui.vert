#version 460
// Panels: places in pixels, colours as they are shown.
layout(push_constant) uniform Block {
    vec2 scale;
    vec2 shift;
};

layout(location = 0) in vec2 place;
layout(location = 1) in vec2 glyph;
layout(location = 2) in vec4 colour;

layout(location = 0) out vec2 glyph_place;
layout(location = 1) out vec4 ink;

void main() {
    glyph_place = glyph;
    ink = colour;
    gl_Position = vec4(place * scale + shift, 0.0, 1.0);
}

#version 460
layout(binding = 0) uniform sampler2D glyphs;

layout(location = 0) in vec2 glyph_place;
layout(location = 1) in vec4 ink;

layout(location = 0) out vec4 picture;

void main() {
    picture = vec4(ink.rgb, ink.a * texture(glyphs, glyph_place).r);
}

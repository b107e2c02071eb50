#version 330 core
#include "colour.glsl"
#include "lighting.glsl"
uniform float opacity;
in vec3 eye_position, normal;
flat in vec4 arrow_colour;
out vec4 shown;

void main() {
    vec3 bright = lit(arrow_colour.rgb, normalize(normal), normalize(-eye_position), 0.8);
    shown = vec4(to_srgb(bright), arrow_colour.a * opacity);
}

#version 330 core
uniform vec4 outline;
uniform float outline_width, opacity;
flat in vec4 fill;
flat in float radius;
out vec4 shown;

float disc(float r, float distance) { return 1.0 - smoothstep(r - 0.6, r + 0.6, distance); }

void main() {
    vec2 place = (2.0 * gl_PointCoord - 1.0) * (radius + outline_width + 1.0);
    float from_middle = length(place);
    float whole = disc(radius + outline_width, from_middle), inner = disc(radius, from_middle);
    float dome = dot(place / max(radius, 1.0), vec2(-0.45, -0.65));
    vec3 body = fill.rgb * (1.0 + 0.14 * dome) + 0.05 * max(dome, 0.0);
    float alpha = whole * mix(outline.a, 1.0, inner) * fill.a * opacity;
    if (alpha < 0.01) discard;
    shown = vec4(mix(outline.rgb, body, inner), alpha);
}

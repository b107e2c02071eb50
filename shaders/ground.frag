#version 330 core
uniform vec4 line;
uniform vec2 phase;
uniform float cells, shadow_part, shadow_opacity;
uniform sampler2D shadow;
in vec2 place;
out vec4 shown;

// Cover of lines one pixel wide at whole numbers; fades to their mean where they are denser than pixels.
float grid(vec2 at) {
    vec2 width = vec2(length(vec2(dFdx(at.x), dFdy(at.x))), length(vec2(dFdx(at.y), dFdy(at.y))));
    vec2 distance = abs(at - round(at)) / max(width, 1e-9);
    vec2 cover = (1.0 - smoothstep(0.2, 1.2, distance)) * (1.0 - smoothstep(0.15, 0.5, width));
    return max(cover.x, cover.y);
}

void main() {
    vec2 at = place * cells + phase;
    float fade = 1.0 - smoothstep(0.15, 1.0, length(place));
    float cover = max(0.45 * grid(at), grid(at / 5.0));
    vec2 in_shadow = 0.5 + 0.5 * place / shadow_part;
    float dark = 0.0;
    if (shadow_opacity > 0.0 && in_shadow == clamp(in_shadow, 0.0, 1.0))
        dark = shadow_opacity * texture(shadow, in_shadow).r;
    float lines = line.a * cover * fade * (1.0 - dark), covered = dark + lines;
    shown = vec4(line.rgb * lines / max(covered, 1e-4), covered);
    if (shown.a < 0.004) discard;
}

#version 330 core
uniform vec4 colour;
uniform float width;
noperspective in float across;
out vec4 shown;

void main() {
    float cover = 1.0 - smoothstep(0.5 * width - 0.5, 0.5 * width + 0.5, abs(across));
    if (cover <= 0.0) discard;
    shown = vec4(colour.rgb, colour.a * cover);
}

#version 330 core
uniform vec4 colour;
uniform float width, dash;
noperspective in vec2 place;
out vec4 shown;

void main() {
    float cover = 1.0 - smoothstep(0.5 * width - 0.5, 0.5 * width + 0.5, abs(place.y));
    if (dash > 0.0) {
        float from_middle = abs(mod(place.x, 2.0 * dash) - 0.5 * dash);
        cover *= 1.0 - smoothstep(0.5 * dash - 0.5, 0.5 * dash + 0.5, min(from_middle, 2.0 * dash - from_middle));
    }
    if (cover <= 0.0) discard;
    shown = vec4(colour.rgb, colour.a * cover);
}

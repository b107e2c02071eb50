#version 330 core
uniform vec4 top, bottom;
in float height;
out vec4 shown;

// Noise of half a step of the screen hides the steps of a faint gradient.
float noise(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5; }

void main() {
    vec3 colour = mix(bottom.rgb, top.rgb, smoothstep(0.0, 1.0, height));
    shown = vec4(colour + noise(gl_FragCoord.xy) / 255.0, 1.0);
}

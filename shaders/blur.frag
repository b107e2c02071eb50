#version 330 core
// Along one axis, by binomial weights.
uniform sampler2D picture;
uniform vec2 step;  // [texels]
out float blurred;

void main() {
    const float weights[7] = float[7](0.1964, 0.1747, 0.1229, 0.0685, 0.0302, 0.0105, 0.0029);
    vec2 size = vec2(textureSize(picture, 0)), at = gl_FragCoord.xy / size;
    blurred = weights[0] * texture(picture, at).r;
    for (int i = 1; i < 7; ++i)
        blurred += weights[i] * (texture(picture, at + float(i) * step / size).r +
                                 texture(picture, at - float(i) * step / size).r);
}

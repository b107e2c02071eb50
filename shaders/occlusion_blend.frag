#version 330 core
// The occlusion of sixteen neighbours, as far as they lie at the same depth, as black with an opacity.
uniform sampler2D depths, occlusion;
uniform mat4 projection;
uniform float reach, strength;
uniform ivec2 first_cell, first_pixel;  // at the corners of the occlusion and of what is drawn to
out vec4 shown;

float eye_depth(float depth) { return projection[3][2] / (2.0 * depth - 1.0 + projection[2][2]); }

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy) + first_pixel, last = textureSize(occlusion, 0) - 1;
    float depth = texelFetch(depths, pixel, 0).r;
    if (depth >= 1.0) discard;
    float here = eye_depth(depth), sum = 0.0, weights = 0.0;
    ivec2 corner = (pixel - 3) / 2;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            ivec2 at = first_cell + clamp(corner + ivec2(x, y) - first_cell, ivec2(0), last);
            float other = eye_depth(texelFetch(depths, min(2 * at, textureSize(depths, 0) - 1), 0).r);
            float weight = max(1.0 - abs(other - here) / (0.3 * reach), 0.0) + 1e-4;
            sum += weight * texelFetch(occlusion, at - first_cell, 0).r;
            weights += weight;
        }
    shown = vec4(0.0, 0.0, 0.0, strength * (1.0 - sum / weights));
}

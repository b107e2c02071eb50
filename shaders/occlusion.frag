#version 330 core
// How much of the sky a point of the surface sees, from the depths of the picture alone: the estimator of McGuire,
// Mara and Luebke, "Scalable ambient obscurance" (2012), eqn. 1, at a quarter of the pixels.
uniform sampler2D depths;
uniform mat4 projection;
uniform float reach;  // [eye units]
uniform ivec2 first_cell;  // of the picture, at the corner of what is drawn to: a cell is two by two pixels
out float open;

const int kSamples = 14;
const float kTurns = 5.0, kPi = 3.14159265;

float eye_depth(float depth) {  // positive
    return projection[3][2] / (2.0 * depth - 1.0 + projection[2][2]);
}

vec3 eye_position(ivec2 pixel, float depth) {
    vec2 size = vec2(textureSize(depths, 0)), at = (vec2(pixel) + 0.5) / size * 2.0 - 1.0;
    float z = eye_depth(depth);
    return vec3((at + projection[2].xy) * z / vec2(projection[0][0], projection[1][1]), -z);
}

vec3 position_at(ivec2 pixel) {
    ivec2 inside = clamp(pixel, ivec2(0), textureSize(depths, 0) - 1);
    return eye_position(inside, texelFetch(depths, inside, 0).r);
}

// The smaller of the steps to either side: the other one may cross an outline.
vec3 tangent(vec3 here, ivec2 pixel, ivec2 step) {
    vec3 after = position_at(pixel + step) - here, before = here - position_at(pixel - step);
    return abs(after.z) < abs(before.z) ? after : before;
}

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy) + first_cell, pixel = 2 * place;
    float depth = texelFetch(depths, pixel, 0).r;
    open = 1.0;
    if (depth >= 1.0) return;
    vec3 here = eye_position(pixel, depth);
    vec3 normal = normalize(cross(tangent(here, pixel, ivec2(2, 0)), tangent(here, pixel, ivec2(0, 2))));
    float height = float(textureSize(depths, 0).y);
    float radius = min(0.5 * height * projection[1][1] * reach / -here.z, 0.4 * height);
    ivec2 cell = place & 3;
    float phase = float((cell.x * 4 + cell.y * 7 + 3 * (cell.x ^ cell.y)) & 15) / 16.0 * 2.0 * kPi;
    float sum = 0.0;
    for (int i = 0; i < kSamples; ++i) {
        float part = (float(i) + 0.5) / float(kSamples), angle = part * kTurns * 2.0 * kPi + phase;
        vec3 to = position_at(pixel + ivec2(radius * part * vec2(cos(angle), sin(angle)))) - here;
        float square = dot(to, to), fall = max(reach * reach - square, 0.0);
        sum += fall * fall * fall * max((dot(to, normal) - 0.02 * reach) / (square + 1e-4 * reach * reach), 0.0);
    }
    float r2 = reach * reach;
    open = clamp(1.0 - 0.4 * reach * sum / (r2 * r2 * r2) * (5.0 / float(kSamples)), 0.0, 1.0);
}

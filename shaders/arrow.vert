#version 330 core
#include "colour.glsl"
layout(location = 0) in vec2 circle;   // cosine and sine of the angle about the axis
layout(location = 1) in vec4 profile;  // off the axis: x shaft + y head radii; along it: z necks + w lengths
layout(location = 2) in vec2 profile_normal;
layout(location = 3) in vec3 from;
layout(location = 4) in vec3 vector;
layout(location = 5) in vec4 colour;
uniform mat4 model_view, projection;
uniform float width, pixel_slope;

const float kHeadRadius = 2.3;  // in radii of the shaft
const float kHeadSlope = 2.6;   // length of the head / its radius

out vec3 eye_position, normal;
flat out vec4 arrow_colour;  // linear

void main() {
    vec3 tail = (model_view * vec4(from, 1.0)).xyz, span = mat3(model_view) * vector;
    float len = length(span);
    vec3 axis = span / len;
    vec3 first = normalize(cross(axis, abs(axis.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0)));
    vec3 second = cross(axis, first);
    float depth = max(-(tail.z + 0.5 * span.z), 0.0);
    float shaft = 0.5 * width * pixel_slope * depth;
    float head_length = kHeadRadius * kHeadSlope * shaft;
    float shrink = min(1.0, 0.8 * len / head_length);
    shaft *= shrink;
    head_length *= shrink;
    float across = shaft * (profile.x + kHeadRadius * profile.y);
    float along = profile.z * (len - head_length) + profile.w * len;
    vec3 outward = circle.x * first + circle.y * second;
    eye_position = tail + along * axis + across * outward;
    normal = profile_normal.x * outward + profile_normal.y * axis;
    arrow_colour = vec4(to_linear(colour.rgb), colour.a);
    gl_Position = projection * vec4(eye_position, 1.0);
}

#version 330 core
#include "colour.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float scalar;
layout(location = 3) in vec4 tint;
uniform mat4 model_view, projection;

out Vertex {
    vec3 eye_position, normal;
    float scalar;
    vec4 tint;
} vertex;

void main() {
    vec4 eye_position = model_view * vec4(position, 1.0);
    vertex.eye_position = eye_position.xyz;
    vertex.normal = mat3(model_view) * normal;
    vertex.scalar = scalar;
    vertex.tint = vec4(to_linear(tint.rgb), tint.a);
    gl_Position = projection * eye_position;
}

#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float scalar;
uniform mat4 model_view, projection;
uniform float push;  // away from the eye, of the distance

out Vertex {
    vec3 eye_position, normal;
    float scalar;
} vertex;

void main() {
    vec4 eye_position = model_view * vec4(position, 1.0);
    vertex.eye_position = eye_position.xyz;
    vertex.normal = mat3(model_view) * normal;
    vertex.scalar = scalar;
    gl_Position = projection * vec4(eye_position.xyz * (1.0 + push), 1.0);
}

#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 model_view, projection;
uniform float width, pixel_slope;

void main() {
    vec4 eye_position = model_view * vec4(position, 1.0);
    eye_position.xyz *= 1.0 - 2.0 * (width + 0.5) * pixel_slope;  // nearer, at the same pixel
    gl_Position = projection * eye_position;
}

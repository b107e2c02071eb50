#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in float size;
layout(location = 2) in vec4 colour;
uniform mat4 model_view, projection;
uniform float pixel_slope, pixel_ratio, outline_width;

flat out vec4 fill;
flat out float radius;  // without the outline [pixels]

void main() {
    radius = 0.5 * size * pixel_ratio;
    fill = colour;
    float reach = radius + outline_width + 1.0;
    vec4 eye_position = model_view * vec4(position, 1.0);
    eye_position.xyz *= 1.0 - reach * pixel_slope;  // nearer, at the same pixel
    gl_Position = projection * eye_position;
    gl_PointSize = 2.0 * reach;
}

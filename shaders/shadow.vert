#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 onto_ground;  // x, y in the plane, 1 at the borders of the picture; z the height in it
out float height;

void main() {
    vec4 at = onto_ground * vec4(position, 1.0);
    height = at.z;
    gl_Position = vec4(at.xy, clamp(at.z, 0.0, 1.0) * 1.8 - 0.9, 1.0);  // the lowest is nearest
}

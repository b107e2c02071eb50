#version 330 core
uniform mat4 model_view, projection;
uniform vec3 first_axis, second_axis;

out vec2 place;  // 1 where the grid is gone

void main() {
    place = vec2(gl_VertexID % 2, gl_VertexID / 2) * 2.0 - 1.0;
    gl_Position = projection * model_view * vec4(place.x * first_axis + place.y * second_axis, 1.0);
}

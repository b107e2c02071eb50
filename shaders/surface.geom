#version 330 core
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
uniform int scalar_source;  // 0 none, 1 per vertex, 2 per triangle
uniform bool flat_normals;
uniform samplerBuffer triangle_scalars;

in Vertex {
    vec3 eye_position, normal;
    float scalar;
} corners[];

out Fragment {
    vec3 eye_position, normal, barycentric;
    float scalar;
} fragment;

void main() {
    vec3 ab = corners[1].eye_position - corners[0].eye_position;
    vec3 ac = corners[2].eye_position - corners[0].eye_position;
    vec3 face_normal = normalize(cross(normalize(ab), normalize(ac)));
    for (int i = 0; i < 3; ++i) {
        bool collapsed = dot(corners[i].normal, corners[i].normal) == 0.0;
        fragment.eye_position = corners[i].eye_position;
        fragment.normal = flat_normals || collapsed ? face_normal : corners[i].normal;
        fragment.barycentric = vec3(i == 0, i == 1, i == 2);
        fragment.scalar = scalar_source == 2 ? texelFetch(triangle_scalars, gl_PrimitiveIDIn).x : corners[i].scalar;
        gl_Position = gl_in[i].gl_Position;
        EmitVertex();
    }
    EndPrimitive();
}

#version 330 core
layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;
uniform vec2 picture_size;
uniform float width;

noperspective out float across;  // the line [pixels]

// The end of a segment, or where it passes the near plane.
vec4 clipped(vec4 end, vec4 other) {
    float near = end.z + end.w, other_near = other.z + other.w;
    return near >= 0.0 ? end : mix(end, other, near / (near - other_near));
}

void emit(vec4 end, vec2 offset, float at) {
    across = at;
    gl_Position = vec4(end.xy + 2.0 * offset / picture_size * end.w, end.zw);
    EmitVertex();
}

void main() {
    vec4 a = gl_in[0].gl_Position, b = gl_in[1].gl_Position;
    if (a.z + a.w < 0.0 && b.z + b.w < 0.0) return;
    vec4 from = clipped(a, b), to = clipped(b, a);
    vec2 along = (to.xy / to.w - from.xy / from.w) * 0.5 * picture_size;
    float len = length(along);
    if (len < 1e-4) return;
    vec2 side = vec2(-along.y, along.x) / len;
    float reach = 0.5 * width + 1.0;
    emit(from, -reach * side, -reach);
    emit(from, reach * side, reach);
    emit(to, -reach * side, -reach);
    emit(to, reach * side, reach);
    EndPrimitive();
}

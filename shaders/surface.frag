#version 330 core
#include "colour.glsl"
#include "lighting.glsl"
uniform vec4 colour, inside;  // linear, as the colours of the map
uniform vec4 wire;
uniform float opacity, light, wire_width;
uniform int scalar_source;
uniform bool scalar_log;
uniform float scalar_low, scalar_scale, scalar_offset, contour_bands;
uniform sampler2D colour_map;

in Fragment {
    vec3 eye_position, normal, barycentric;
    float scalar;
} fragment;

out vec4 shown;

float pixels_per_unit(float x) { return 1.0 / max(length(vec2(dFdx(x), dFdy(x))), 1e-12); }

// Of the map at t. With bands, one colour each, and a line of about a pixel between them.
vec3 mapped(float t) {
    t = clamp(t, 0.0, 1.0);
    float bands = max(contour_bands, 1.0), place = t * bands;
    float banded_t = (min(floor(place), bands - 1.0) + 0.5) / bands;
    float from_line = abs(place - round(place)) * pixels_per_unit(place);
    float inner = step(0.5, place) * step(place, bands - 0.5);
    float line = (1.0 - smoothstep(0.3, 1.3, from_line)) * inner;
    bool banded = contour_bands > 0.5;
    vec3 colour = texture(colour_map, vec2(((banded ? banded_t : t) * 255.0 + 0.5) / 256.0, 0.5)).rgb;
    return colour * (banded ? mix(1.0, 0.45, line) : 1.0);
}

vec3 surface_colour() {
    float value = scalar_log ? log(max(fragment.scalar, 1e-37)) / log(10.0) : fragment.scalar;
    float t = (value - scalar_low) * scalar_scale + scalar_offset;
    bool has_value = scalar_source != 0 && !isnan(fragment.scalar) && !isinf(t);
    return has_value ? mapped(t) : colour.rgb;
}

// How much of this pixel the edges of the triangle cover. Fades where triangles are but a few pixels.
float wire_cover() {
    vec3 per_unit = vec3(pixels_per_unit(fragment.barycentric.x), pixels_per_unit(fragment.barycentric.y),
                         pixels_per_unit(fragment.barycentric.z));
    vec3 pixels = fragment.barycentric * per_unit;
    float nearest = min(pixels.x, min(pixels.y, pixels.z));
    float height = min(per_unit.x, min(per_unit.y, per_unit.z));
    float cover = 1.0 - smoothstep(0.5 * wire_width - 0.5, 0.5 * wire_width + 0.5, nearest);
    return cover * smoothstep(1.5, 9.0, height);
}

void main() {
    float side = gl_FrontFacing ? 1.0 : -1.0;
    vec3 normal = side * normalize(fragment.normal);
    vec3 to_eye = normalize(-fragment.eye_position);
    vec3 albedo = surface_colour();
    if (!gl_FrontFacing && opacity == 1.0) albedo = mix(albedo, inside.rgb, 0.7 * inside.a);
    float gloss = scalar_source == 0 ? 1.0 : 0.45;
    vec3 bright = mix(albedo, lit(albedo, normal, to_eye, gloss), light);
    float covered = wire_cover() * wire.a;
    float grazing = 1.0 - abs(dot(normal, to_eye));
    float cover = mix(opacity, 1.0, 0.5 * grazing * grazing);  // as glass: denser towards its outline
    if (opacity == 1.0) cover = 1.0;
    // An outline alone: flat faces have none, at whatever angle they are seen; their edges are drawn.
    if (opacity == 0.0) cover *= smoothstep(0.0, 2e-3, length(fwidth(normal)));
    shown = vec4(mix(to_srgb(bright), wire.rgb, covered), mix(cover, 1.0, 0.6 * covered));
}

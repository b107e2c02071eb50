// Light of the studio, in eye coordinates: a key from the upper left, a weak fill from the right, and a dome that is
// brighter towards `up` of the world. A white surface that faces the eye comes out at about 1.
uniform vec3 up;

vec3 in_studio(vec3 albedo, vec3 normal, vec3 to_eye, float gloss) {
    const vec3 key = normalize(vec3(-0.42, 0.62, 0.85));
    const vec3 fill = normalize(vec3(0.85, -0.10, 0.45));
    float dome = 0.5 + 0.5 * dot(normal, up);
    vec3 light = mix(vec3(0.115, 0.11, 0.11), vec3(0.285, 0.30, 0.325), dome);
    light += vec3(0.86, 0.84, 0.81) * max(0.95 * dot(normal, key) + 0.05, 0.0);
    light += vec3(0.15, 0.16, 0.18) * max(dot(normal, fill), 0.0);
    float grazing = 1.0 - max(dot(normal, to_eye), 0.0);
    float rim = grazing * grazing * grazing * grazing * (0.3 + 0.7 * dome);
    float glint = max(dot(normal, normalize(key + to_eye)), 0.0);
    for (int i = 0; i < 6; ++i) glint *= glint;  // to the power of 64
    return albedo * (light + 0.22 * rim) + gloss * (0.16 * glint + 0.05 * rim);
}

// Materials whose light is a picture of the normal in eye coordinates alone, as of a ball of clay, wax or metal.
vec3 in_clay(vec3 albedo, vec3 normal, vec3 to_eye) {
    float wrapped = 0.5 + 0.5 * dot(normal, normalize(vec3(-0.35, 0.65, 0.70)));
    float facing = max(dot(normal, to_eye), 0.0);
    vec3 light = mix(vec3(0.16, 0.15, 0.17), vec3(1.02, 1.0, 0.97), wrapped * wrapped);
    return albedo * light * mix(0.62, 1.0, smoothstep(0.0, 0.55, facing));
}

vec3 in_wax(vec3 albedo, vec3 normal, vec3 to_eye, float gloss) {
    const vec3 key = normalize(vec3(-0.42, 0.62, 0.85));
    vec3 reach = vec3(0.55, 0.34, 0.26);  // red light goes farthest under the skin, past the terminator
    vec3 wrapped = clamp((vec3(dot(normal, key)) + reach) / (1.0 + reach), 0.0, 1.0);
    float grazing = 1.0 - max(dot(normal, to_eye), 0.0);
    float glint = pow(max(dot(normal, normalize(key + to_eye)), 0.0), 22.0);
    vec3 light = 0.22 + 0.82 * wrapped * wrapped + 0.18 * grazing * grazing;
    return albedo * light + gloss * 0.16 * glint;
}

vec3 in_metal(vec3 albedo, vec3 normal, vec3 to_eye, float gloss) {
    vec3 mirrored = reflect(-to_eye, normal);
    float height = dot(mirrored, up);
    float sky = mix(0.30, 1.05, smoothstep(-0.05, 0.75, height)), ground = mix(0.42, 0.08, smoothstep(-0.9, 0.0, height));
    float room = mix(ground, sky, smoothstep(-0.06, 0.06, height));
    float lamp = pow(max(dot(mirrored, normalize(vec3(-0.45, 0.60, 0.66))), 0.0), 40.0);
    float away = clamp(1.0 - dot(normal, to_eye), 0.0, 1.0), grazing = away * away * away * away;
    vec3 tint = mix(albedo, vec3(1.0), 0.5 * grazing);
    return tint * (0.35 * max(normal.z, 0.0) + 0.75 * room) + gloss * 0.6 * lamp;
}

uniform int material;  // as the list of SurfaceMaterial

vec3 lit(vec3 albedo, vec3 normal, vec3 to_eye, float gloss) {
    if (material == 1) return in_clay(albedo, normal, to_eye);
    if (material == 2) return in_wax(albedo, normal, to_eye, gloss);
    if (material == 3) return in_metal(albedo, normal, to_eye, gloss);
    return in_studio(albedo, normal, to_eye, gloss);
}

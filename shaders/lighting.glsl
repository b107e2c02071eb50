// Light of the studio, in eye coordinates: a key from the upper left, a weak fill from the right, and a dome that is
// brighter towards `up` of the world. A white surface that faces the eye comes out at about 1.
uniform vec3 up;

vec3 lit(vec3 albedo, vec3 normal, vec3 to_eye, float gloss) {
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

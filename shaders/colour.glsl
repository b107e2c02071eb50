vec3 to_linear(vec3 srgb) {
    return mix(srgb / 12.92, pow((srgb + 0.055) / 1.055, vec3(2.4)), step(vec3(0.04045), srgb));
}

// By square roots in place of the power: within half a step of 8 bits.
vec3 to_srgb(vec3 linear) {
    linear = clamp(linear, 0.0, 1.0);
    vec3 a = sqrt(linear), b = sqrt(a), c = sqrt(b);
    vec3 high = 0.662002687 * a + 0.684122060 * b - 0.323583601 * c - 0.0225411470 * linear;
    return mix(12.92 * linear, high, step(vec3(0.0031308), linear));
}

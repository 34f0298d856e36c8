// common/tones.glsl: exposure and tone mapping, both on linear light: the twin of core/scene/tones.

uniform float exposureGain;  // linear light times this
uniform bool filmicCurve;

// IEC 61966-2-1.
vec3 linearFromSrgb(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}
vec3 srgbFromLinear(vec3 c) {
    return mix(c * 12.92, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

// A colour that is not multiplied by alpha.
vec3 toned(vec3 color) {
    vec3 light = exposureGain * linearFromSrgb(clamp(color, 0.0, 4.0));
    vec3 x = 0.72317 * light;
    if (filmicCurve) light = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    return srgbFromLinear(light);
}

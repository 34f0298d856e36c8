// common/lighting.glsl: Blinn-Phong as core's shade() has it: two-sided, white light, unlit without a gradient.

uniform vec4 lighting;     // ambient, diffuse, specular, shininess
uniform vec4 towardLight;  // world space; w = 0: headlight

// Light reflected as a factor on the colour (x) and white on top of it (y). `ray` points away from the eye.
vec2 reflected(vec3 gradient, vec3 ray) {
    // By the largest component first: squares of steep formulas' gradients overflow.
    vec3 scaled = gradient / max(max(abs(gradient.x), abs(gradient.y)), abs(gradient.z));
    float steepness = length(scaled);
    if (!(steepness > 0.0)) return vec2(1.0, 0.0);
    vec3 normal = scaled / steepness;
    vec3 toEye = -normalize(ray);
    vec3 toLight = towardLight.w == 0.0 ? toEye : towardLight.xyz;
    vec3 between = toLight + toEye;
    float width = length(between);
    float highlight = width > 0.0 ? abs(dot(normal, between / width)) : 0.0;
    return vec2(lighting.x + lighting.y * abs(dot(normal, toLight)), lighting.z * pow(highlight, lighting.w));
}

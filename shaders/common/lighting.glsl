// common/lighting.glsl: Blinn-Phong as core's litColor() has it: white lights, unlit without a gradient.

uniform vec4 lighting;  // ambient (the rig's factor in it), diffuse, specular, shininess
uniform int lightKind;  // 0: one, from the eye; 1: one that stays, two-sided; 2: a rig, on the side that the eye sees
uniform int lightCount;
uniform vec3 lightsToward[3];     // world space, unit; the first one's shadows count
uniform float lightIntensity[3];

vec3 towardFirst(vec3 toEye) {
    return lightKind == 0 ? toEye : lightsToward[0];
}

// Light reflected as a factor on the colour (x) and white on top of it (y). `ray` points away from the eye; `share` is
// what surroundings leave of the first light and of the light from everywhere.
vec2 reflected(vec3 gradient, vec3 ray, vec2 share) {
    // By the largest component first: squares of steep formulas' gradients overflow.
    vec3 scaled = gradient / max(max(abs(gradient.x), abs(gradient.y)), abs(gradient.z));
    float steepness = length(scaled);
    if (!(steepness > 0.0)) return vec2(1.0, 0.0);
    vec3 normal = scaled / steepness;
    vec3 toEye = -normalize(ray);
    bool rig = lightKind == 2;
    if (rig && dot(normal, toEye) < 0.0) normal = -normal;
    vec2 sum = vec2(0.0);
    for (int l = 0; l < lightCount; ++l) {
        vec3 toward = l == 0 ? towardFirst(toEye) : lightsToward[l];
        float intensity = lightIntensity[l] * (l == 0 ? share.x : 1.0);
        vec3 between = toward + toEye;
        float width = length(between);
        vec2 facing = vec2(dot(normal, toward), width > 0.0 ? dot(normal, between / width) : 0.0);
        facing = rig ? max(facing, 0.0) : abs(facing);
        sum.x += intensity * facing.x;
        if (!rig || facing.x > 0.0) sum.y += intensity * pow(facing.y, lighting.w);
    }
    return vec2(lighting.x * share.y + lighting.y * sum.x, lighting.z * sum.y);
}

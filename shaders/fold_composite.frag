#version 450 core
// fold_composite.frag: the combined pre-images of one slice, as a slab of its material.
//   variants  MERGE         sampled holds sums of colour times opacity, and of opacity
//             INTERSECTION  the thickness is that of `lit`, the smallest
//   out       color         premultiplied by alpha, to be composited under what is there

uniform sampler2D sampled;
uniform sampler2D lit;
uniform mat3 rayPerDepth;       // world direction of unit depth: [0] + x [1] + y [2]
uniform float slabDepth;        // world units
uniform float opacityDistance;  // world units

layout(location = 0) out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 what = texelFetch(sampled, pixel, 0);
    vec4 light = texelFetch(lit, pixel, 0);
#if defined(MERGE)
    if (what.a == 0.0) discard;
    vec3 seen = what.rgb / what.a;
    float thickness = -log(1.0 - min(what.a, 0.9999));
#elif defined(INTERSECTION)
    vec3 seen = what.rgb;
    float thickness = light.z;
#else
    vec3 seen = what.rgb;
    float thickness = what.a;
#endif
    if (thickness == 0.0) discard;
    float len = length(rayPerDepth * vec3(1.0, gl_FragCoord.xy));
    float alpha = 1.0 - exp(-thickness * slabDepth * len / opacityDistance);
    color = vec4((seen * light.x + light.y) * alpha, alpha);
}

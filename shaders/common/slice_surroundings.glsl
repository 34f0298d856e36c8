// common/slice_surroundings.glsl: surroundings of what slices show.
// Needs common/slice_input.glsl and common/surroundings.glsl.

// What is left of the first light (x) and of the light from everywhere (y), at a depth from the slice, for a share
// `alpha` of what is seen.
vec2 lightShare(float depth, float alpha, vec3 ray) {
#ifdef SURROUNDINGS
    if (alpha > 1e-4) return lightShareAt(sliceDepth + depth, ray);
#endif
    return vec2(1.0);
}

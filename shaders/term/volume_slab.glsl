// term/volume_slab.glsl: colour and opacity of a slab of one volume.
// The scalar is taken at the ends of SEGMENTS equal parts of the slab and is linear between them; each part that is
// not certainly clear is classified at SUBSAMPLES points, composited front to back, and lit by the gradient at the mean
// place of what is seen of it.
// Needs common/slab_ray.glsl or located_ray.glsl, classification.glsl, lighting.glsl.

uniform float opacityDistance;  // world units
uniform float gradientUnit;     // data units per raw unit
uniform mat3 restFromIndexGradient;  // index gradient to the volume's own world

// at   the ray by index coordinates
// ray  its world direction of unit depth
vec4 volumeSlab(SlabRay at, vec3 ray) {
    vec2 extent = slabExtent(at);
    float segmentDepth = (extent.y - extent.x) / float(SEGMENTS);
    float sampleLength = segmentDepth * length(ray) / float(SUBSAMPLES) / opacityDistance;
    vec3 seen = vec3(0.0);
    float through = 1.0;
#ifdef GRADIENT_OPACITY
    float factor = -1.0;
#endif

    vec3 index;
    bool known[SEGMENTS + 1];
    float raw[SEGMENTS + 1];
    float entry[SEGMENTS + 1];
    float lowest = tableSize;
    float highest = -1.0;
    for (int s = 0; s <= SEGMENTS; ++s) {
        known[s] = indexOn(at, extent.x + float(s) * segmentDepth, index);
        raw[s] = rawAt(index);
        entry[s] = entryOf(raw[s]);
        lowest = min(lowest, entry[s]);
        highest = max(highest, entry[s]);
    }
    // Most of space is empty, and most of that is told from the extremes alone.
    if (highest < visibleEntries.x || lowest > visibleEntries.y) return vec4(0.0);
    for (int s = 0; s < SEGMENTS; ++s) {
        if (!known[s] || !known[s + 1]) continue;
        if (max(entry[s], entry[s + 1]) < visibleEntries.x || min(entry[s], entry[s + 1]) > visibleEntries.y) continue;
#ifdef REAL_VOXELS
        if (!isNumber(raw[s]) || !isNumber(raw[s + 1])) continue;
#endif
        vec3 part = vec3(0.0);
        float before = through;
        float where = 0.0;  // sum of depth by what is seen
        for (int n = 0; n < SUBSAMPLES; ++n) {
            float place = (float(n) + 0.5) / float(SUBSAMPLES);
            float between = mix(entry[s], entry[s + 1], place);
            float thickness = thicknessAt(between);
            if (thickness > 0.0) {
                float depth = extent.x + (float(s) + place) * segmentDepth;
#ifdef GRADIENT_OPACITY
                if (factor < 0.0) {
                    indexOn(at, depth, index);
                    factor = gradientFactor(length(restFromIndexGradient * rawDifferencesAt(index)) * gradientUnit);
                }
                thickness = -log(1.0 - clamp(factor * (1.0 - exp(-thickness)), 0.0, 0.9999));
#endif
                float left = exp(-thickness * sampleLength);
                float weight = through * (1.0 - left);
                part += weight * colorAt(between);
                where += weight * depth;
                through *= left;
            }
        }
#ifdef SHADED
        float alpha = before - through;
        if (alpha > 0.0) {
            mat3 jacobian;
            Entered face = placeOn(at, where / alpha, ray, index, jacobian);
            vec3 gradient = withCut(cutBy(face, ray), rawDifferencesAt(index) * jacobian);
            vec2 light = reflected(gradient, ray, lightShare(where / alpha, alpha, ray));
            part = part * light.x + alpha * light.y;
        }
#endif
        seen += part;
    }
    return vec4(seen, 1.0 - through);
}

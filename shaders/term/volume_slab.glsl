// term/volume_slab.glsl: colour and opacity of a slab of one volume.
// The scalar is taken at the ends of SEGMENTS equal parts of the slab and is linear between them; each part that is
// not certainly clear is classified at SUBSAMPLES points, composited front to back, and lit by the gradient at the mean
// place of what is seen of it.
// Needs common/volume.glsl, classification.glsl, lighting.glsl.

uniform float slabDepth;        // extent of a slab along the view axis, world units
uniform float opacityDistance;  // world units
uniform float gradientUnit;     // data units per raw unit
uniform mat3 restFromIndexGradient;  // index gradient to the volume's own world

// The part of the ray, by depth from the slice, that its slab stands for: half a slab on either side, but at the volume's
// faces exactly up to the face. The neighbouring slice, which lies outside the volume there, draws nothing.
vec2 slabExtent(vec3 index, vec3 perDepth) {
    vec3 reach = abs(slabDepth * perDepth);
    vec2 middle = vec2(-0.5, 0.5) * slabDepth;
    if (all(greaterThan(index - reach, domainMin)) && all(lessThan(index + reach, domainMax))) return middle;
    vec2 face = domainCrossings(index, perDepth);
    return vec2(face.x > -slabDepth ? face.x : middle.x, face.y < slabDepth ? face.y : middle.y);
}

// index, perDepth  index coordinates on the slice and their change per unit of depth along the ray
// ray              world direction of unit depth
// jacobian         d index / d world
vec4 volumeSlab(vec3 index, vec3 perDepth, vec3 ray, mat3 jacobian) {
    vec2 extent = slabExtent(index, perDepth);
    float segmentDepth = (extent.y - extent.x) / float(SEGMENTS);
    float sampleLength = segmentDepth * length(ray) / float(SUBSAMPLES) / opacityDistance;
    vec3 seen = vec3(0.0);
    float through = 1.0;
#ifdef GRADIENT_OPACITY
    float factor = -1.0;
#endif

    float raw[SEGMENTS + 1];
    float entry[SEGMENTS + 1];
    float lowest = tableSize;
    float highest = -1.0;
    for (int s = 0; s <= SEGMENTS; ++s) {
        raw[s] = rawAt(index + (extent.x + float(s) * segmentDepth) * perDepth);
        entry[s] = entryOf(raw[s]);
        lowest = min(lowest, entry[s]);
        highest = max(highest, entry[s]);
    }
    // Most of space is empty, and most of that is told from the extremes alone.
    if (highest < visibleEntries.x || lowest > visibleEntries.y) return vec4(0.0);
    for (int s = 0; s < SEGMENTS; ++s) {
        if (max(entry[s], entry[s + 1]) < visibleEntries.x || min(entry[s], entry[s + 1]) > visibleEntries.y) continue;
#ifdef REAL_VOXELS
        if (!isNumber(raw[s]) || !isNumber(raw[s + 1])) continue;
#endif
        vec3 part = vec3(0.0);
        float before = through;
        float where = 0.0;  // sum of depth by what is seen
        for (int n = 0; n < SUBSAMPLES; ++n) {
            float at = (float(n) + 0.5) / float(SUBSAMPLES);
            float between = mix(entry[s], entry[s + 1], at);
            float thickness = thicknessAt(between);
            if (thickness > 0.0) {
                float depth = extent.x + (float(s) + at) * segmentDepth;
#ifdef GRADIENT_OPACITY
                if (factor < 0.0)
                    factor = gradientFactor(
                        length(restFromIndexGradient * rawDifferencesAt(index + depth * perDepth)) * gradientUnit);
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
            vec3 gradient = rawDifferencesAt(index + where / alpha * perDepth);
            vec2 light = reflected(transpose(jacobian) * gradient, ray);
            part = part * light.x + alpha * light.y;
        }
#endif
        seen += part;
    }
    return vec4(seen, 1.0 - through);
}

// term/volume_slab.glsl: colour and opacity of a slab of one volume.
// The scalar is taken at the ends of SEGMENTS equal parts of the slab and is linear between them; each part that is
// not wholly clear is classified at SUBSAMPLES points and composited front to back. One gradient, at the mean place
// of what is seen, lights the slab.
// Needs common/volume.glsl, classification.glsl, lighting.glsl.

uniform float slabDepth;        // extent of a slab along the view axis, world units
uniform float opacityDistance;  // world units
uniform float gradientUnit;     // data units per raw unit
uniform mat3 restFromIndexGradient;  // index gradient to the volume's own world

// The part of the ray, by depth from the slice, that its slab stands for: half a slab on either side, but at the volume's
// faces exactly up to the face. The neighbouring slice, which lies outside the volume there, draws nothing.
vec2 slabExtent(vec3 index, vec3 perDepth) {
    vec2 face = domainCrossings(index, perDepth);
    return vec2(face.x > -slabDepth ? face.x : -0.5 * slabDepth, face.y < slabDepth ? face.y : 0.5 * slabDepth);
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
    float where = 0.0;  // sum of depth by what is seen
#ifdef GRADIENT_OPACITY
    float factor = -1.0;
#endif

    float raw0 = rawAt(index + extent.x * perDepth);
    float entry0 = entryOf(raw0);
    vec2 thick0 = thicknessAt(entry0);
    for (int s = 0; s < SEGMENTS; ++s) {
        float depth1 = extent.x + float(s + 1) * segmentDepth;
        float raw1 = rawAt(index + depth1 * perDepth);
        float entry1 = entryOf(raw1);
        vec2 thick1 = thicknessAt(entry1);
        bool visible = thick0.x > 0.0 || thick1.x > 0.0 || thick0.y != thick1.y;
#ifdef REAL_VOXELS
        visible = visible && isNumber(raw0) && isNumber(raw1);
        raw0 = raw1;
#endif
        if (visible) {
            for (int n = 0; n < SUBSAMPLES; ++n) {
                float at = (float(n) + 0.5) / float(SUBSAMPLES);
                float entry = mix(entry0, entry1, at);
                float thickness = thicknessAt(entry).x;
                if (thickness > 0.0) {
                    float depth = depth1 + (at - 1.0) * segmentDepth;
#ifdef GRADIENT_OPACITY
                    if (factor < 0.0)
                        factor = gradientFactor(
                            length(restFromIndexGradient * rawDifferencesAt(index + depth * perDepth)) * gradientUnit);
                    thickness = -log(1.0 - clamp(factor * (1.0 - exp(-thickness)), 0.0, 0.9999));
#endif
                    float left = exp(-thickness * sampleLength);
                    float weight = through * (1.0 - left);
                    seen += weight * colorAt(entry);
                    where += weight * depth;
                    through *= left;
                }
            }
        }
        entry0 = entry1;
        thick0 = thick1;
    }
    float alpha = 1.0 - through;
#ifdef SHADED
    if (alpha > 0.0) {
        vec3 gradient = rawDifferencesAt(index + where / alpha * perDepth);
        vec2 light = reflected(transpose(jacobian) * gradient, ray);
        seen = seen * light.x + alpha * light.y;
    }
#endif
    return vec4(seen, alpha);
}

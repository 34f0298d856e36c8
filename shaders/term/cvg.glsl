// term/cvg.glsl: the operators of constructive volume geometry (definitions.md §4) on two samples: the twin of
// core/objects/cvg.h, which says what value and gradient are.

vec3 selectedColor(Sample a, Sample b) {
    return a.opacity >= b.opacity ? a.color : b.color;
}

// By weights; the mean where both are 0.
vec3 mixedColor(vec3 a, float weightOfA, vec3 b, float weightOfB) {
    float sum = weightOfA + weightOfB;
    return sum > 0.0 ? (weightOfA * a + weightOfB * b) / sum : 0.5 * (a + b);
}

float valueOfLarger(Sample a, float opacityOfA, Sample b, float opacityOfB) {
    bool second = opacityOfB > opacityOfA || (opacityOfB == opacityOfA && isNan(a.value));
    return second ? b.value : a.value;
}

// Whether both have a surface of solids near.
bool haveDepths(Sample a, Sample b) {
    return !isNan(a.depth) && !isNan(b.depth);
}

Sample cvgUnion(Sample a, Sample b) {
    bool nearer = haveDepths(a, b) && a.opacity == 0.0 && b.opacity == 0.0 && b.depth > a.depth;
    return Sample(max(a.opacity, b.opacity), selectedColor(a, b), valueOfLarger(a, a.opacity, b, b.opacity),
                  b.opacity > a.opacity || nearer ? b.gradient : a.gradient,
                  haveDepths(a, b) ? max(a.depth, b.depth) : undefinedValue());
}

Sample cvgIntersection(Sample a, Sample b) {
    bool solids = haveDepths(a, b);
    bool second = solids ? b.depth < a.depth : b.opacity < a.opacity;
    return Sample(min(a.opacity, b.opacity), selectedColor(a, b), valueOfLarger(a, a.opacity, b, b.opacity),
                  second ? b.gradient : a.gradient, solids ? min(a.depth, b.depth) : undefinedValue());
}

Sample cvgMerge(Sample a, Sample b) {
    return Sample(min(1.0, a.opacity + b.opacity), mixedColor(a.color, a.opacity, b.color, b.opacity),
                  valueOfLarger(a, a.opacity, b, b.opacity), b.opacity > a.opacity ? b.gradient : a.gradient,
                  undefinedValue());
}

Sample cvgDifference(Sample a, Sample b) {
    bool solids = haveDepths(a, b);
    bool bare = solids ? -b.depth < a.depth : b.opacity > 0.0 && b.gradient != vec3(0.0);
    return Sample(max(0.0, a.opacity - b.opacity), a.color, a.value, bare ? -b.gradient : a.gradient,
                  solids ? min(a.depth, -b.depth) : undefinedValue());
}

Sample cvgCap(Sample a, Sample b) {
    bool solids = haveDepths(a, b);
    return Sample(a.opacity <= b.opacity ? a.opacity : 0.0, a.color, a.value,
                  solids && b.depth < a.depth ? b.gradient : a.gradient,
                  solids ? min(a.depth, b.depth) : undefinedValue());
}

Sample cvgTrim(Sample a, Sample b) {
    return Sample(a.opacity >= b.opacity ? a.opacity : 0.0, a.color, a.value, a.gradient, a.depth);
}

Sample cvgBlend(Sample a, Sample b, float weight) {
    float partOfA = (1.0 - weight) * a.opacity;
    float partOfB = weight * b.opacity;
    vec3 color = mixedColor(a.color, partOfA, b.color, partOfB);
    Sample s = Sample(clamp(partOfA + partOfB, 0.0, 1.0), clamp(color, 0.0, 1.0),
                      valueOfLarger(a, partOfA, b, partOfB), partOfB > partOfA ? b.gradient : a.gradient,
                      undefinedValue());
    return isFinite(weight) && isPoint(color) ? s : emptySample();
}

// The pre-images of a folded map one after the other (core/objects/combine.h).
struct Combined {
    Sample result;
    float largest;   // opacities so far
    float smallest;
};

Combined firstPreImage(Sample s) {
    return Combined(s, s.opacity, s.opacity);
}

// `result` is what the operator makes of all so far and s; what of the other members follows from all pre-images at
// once is carried on.
Combined carried(Combined before, Sample s, Sample result, bool shades) {
    bool counts = s.opacity > before.largest || (s.opacity == before.largest && isNan(before.result.value));
    result.value = counts ? s.value : before.result.value;
    result.gradient = shades ? s.gradient : before.result.gradient;
    return Combined(result, max(before.largest, s.opacity), min(before.smallest, s.opacity));
}

Combined combineUnion(Combined before, Sample s) {
    return carried(before, s, cvgUnion(before.result, s), s.opacity > before.largest);
}

Combined combineMerge(Combined before, Sample s) {
    return carried(before, s, cvgMerge(before.result, s), s.opacity > before.largest);
}

Combined combineIntersection(Combined before, Sample s) {
    return carried(before, s, cvgIntersection(before.result, s), s.opacity < before.smallest);
}

Combined combineFirst(Combined before, Sample s) {
    return carried(before, s, before.result, false);
}

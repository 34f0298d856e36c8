// term/maps.glsl: backward maps of a generated program (core/stf). Each gives q and whether it is defined; q is a point in
// any case. Functions that begin with `lit` give d q / d p too, the identity where the map is undefined.

// Where a formula gives `given` for p: its outcome in `q`. `keep`: outside its domain a point stays.
bool formulaMapped(int worldFromFormula, vec3 given, float condition, bool keep, vec3 p, out vec3 q) {
    bool defined = isPoint(given) && condition == 0.0;
    q = defined ? placed(worldFromFormula, given) : p;
    return defined || keep;
}

mat3 formulaJacobian(int worldFromFormula, mat3 derivatives, int formulaFromWorld, bool defined) {
    mat3 j = linearPart(worldFromFormula) * derivatives * linearPart(formulaFromWorld);
    return defined && isPoint(derivatives[0]) && isPoint(derivatives[1]) && isPoint(derivatives[2]) ? j : mat3(1.0);
}

// Three fields' values as a point (`origin`: the group that holds it) or a displacement.
bool fieldsMapped(int origin, vec3 values, bool displacement, bool keep, vec3 p, out vec3 q) {
    bool defined = isPoint(values);
    q = !defined ? p : displacement ? p + values : values - quad(origin).xyz;
    return defined || keep;
}

mat3 rowsToJacobian(vec3 x, vec3 y, vec3 z, bool displacement, bool defined) {
    mat3 j = transpose(mat3(x, y, z));
    return !defined ? mat3(1.0) : displacement ? mat3(1.0) + j : j;
}

// p + k Δ(p), q being p + Δ(p) before.
bool scaledMapped(float k, bool defined, vec3 p, inout vec3 q) {
    q = k == 0.0 ? p : k == 1.0 ? q : p + k * (q - p);
    return k == 0.0 || (defined && isFinite(k));
}

mat3 scaledJacobian(float k, vec3 gradient, bool defined, vec3 delta, mat3 j) {
    mat3 scaled = mat3(1.0) + k * (j - mat3(1.0)) + outerProduct(delta, gradient);
    return defined && isFinite(k) ? scaled : mat3(1.0);
}

// (1 - w) a + w b, into a.
bool blendedMapped(float w, bool defined, vec3 b, inout vec3 a) {
    a = w == 0.0 ? a : w == 1.0 ? b : mix(a, b, w);
    return defined && isFinite(w);
}

mat3 blendedJacobian(float w, vec3 gradient, bool defined, vec3 difference, mat3 ja, mat3 jb) {
    mat3 blended = (1.0 - w) * ja + w * jb + outerProduct(difference, gradient);
    return defined && isFinite(w) ? blended : mat3(1.0);
}

// Whether `candidate` beats `best` as the larger (or else the smaller) displacement of p; the first on a tie.
bool beats(bool larger, vec3 p, vec3 candidate, vec3 best) {
    vec3 c = candidate - p;
    vec3 b = best - p;
    return larger ? dot(c, c) > dot(b, b) : dot(c, c) < dot(b, b);
}

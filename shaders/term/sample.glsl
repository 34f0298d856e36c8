// term/sample.glsl: one point of a spatial object, and the leaves that make it; the definitions of core/objects.
// Functions whose names begin with `lit` give the gradient too.

struct Sample {
    float opacity;  // [0, 1], of one opacity distance
    vec3 color;
    float value;    // the attribute asked for; NaN where there is none
    vec3 gradient;  // that shades, in the space of the point; 0: unlit
    float depth;    // how deep within a surface of solids; NaN where there is none
};

Sample emptySample() {
    return Sample(0.0, vec3(0.0), undefinedValue(), vec3(0.0), undefinedValue());
}

// A scalar through a transfer function. `table` holds colour and opacity.
Sample classified(int table, float value) {
    Sample s = emptySample();
    vec4 entry = tableEntry(table, value);
    bool known = !isNan(value);
    s.value = value;
    s.opacity = known ? clamp(entry.a, 0.0, 1.0) : 0.0;
    s.color = known ? clamp(entry.rgb, 0.0, 1.0) : vec3(0.0);
    return s;
}

// The factor on opacity by the gradient's magnitude.
void fadeBySteepness(int table, vec3 gradient, inout Sample s) {
    s.opacity = clamp(s.opacity * tableEntry(table, length(gradient)).a, 0.0, 1.0);
}

// How far p is outside a box, 0 within it.
//   box  two groups: its least and its largest corner
float distanceOutside(int box, vec3 p) {
    return length(max(max(quad(box).xyz - p, p - quad(box + 1).xyz), vec3(0.0)));
}

// The signed distance of a solid whose shape lies in `box`: what its formula says beyond is not part of it.
float solidDistance(int box, vec3 p, float distance) {
    float outside = distanceOutside(box, p);
    return outside > 0.0 && isFinite(distance) ? max(distance, outside) : distance;
}

//   solid  a group: colour and falloff
Sample solidSample(int solid, float distance, float opacity) {
    Sample s = emptySample();
    float fade = distance <= 0.0 ? 1.0 : max(1.0 - distance / max(quad(solid).w, 1e-30), 0.0);
    s.opacity = isFinite(distance) && isFinite(opacity) ? clamp(opacity, 0.0, 1.0) * fade : 0.0;
    s.color = quad(solid).xyz;
    if (isFinite(distance)) s.depth = -distance;
    return s;
}

// Fields as an object. Opacity or colour that is undefined or infinite is nothing.
Sample fieldsSample(bool inside, float opacity, vec3 color) {
    Sample s = emptySample();
    bool seen = inside && isFinite(opacity) && isPoint(color);
    s.opacity = seen ? clamp(opacity, 0.0, 1.0) : 0.0;
    s.color = seen ? clamp(color, 0.0, 1.0) : vec3(0.0);
    return s;
}

// What tables make of an attribute, `by`, of a sample.
void recolor(int table, bool color, bool opacity, float by, inout Sample s) {
    if (!(s.opacity > 0.0) || isNan(by)) return;
    vec4 entry = tableEntry(table, by);
    if (color) s.color = clamp(entry.rgb, 0.0, 1.0);
    if (opacity) s.opacity = clamp(entry.a, 0.0, 1.0);
}

// A gradient behind a map as one before it; 0 where the Jacobian has no finite answer.
vec3 turnedBack(mat3 jacobian, vec3 gradient) {
    vec3 g = gradient * jacobian;
    return isPoint(g) ? g : vec3(0.0);
}

// box  two groups: its least and its largest corner
bool withinBox(int box, vec3 p) {
    return all(greaterThanEqual(p, quad(box).xyz)) && all(lessThanEqual(p, quad(box + 1).xyz));
}

// common/volume_cut.glsl: plane faces that cut the data: of the volume's box, and of the solids that maps' cells come from.

uniform float cutThickness;  // world units: so deep behind a cut its normal counts wholly, gone at twice that; 0: no cuts
uniform vec3 cutMin;         // of index coordinates: the box that the faces along their axes leave
uniform vec3 cutMax;
// The other faces: xyz · place + w ≥ 0 within. Those before cutPlaneEnds[0] of index coordinates, where one map of cells leads
// there; else of the grid coordinates of the first located map, and the next ones of what each located map gives.
const int kMostCutPlanes = 64;
uniform vec4 cutPlanes[kMostCutPlanes];
uniform int cutPlaneEnds[9];

// The face that a ray entered last before a place.
struct Entered {
    float depth;  // from the place
    vec3 normal;  // world, of any length and sign
};

// Goes on to the faces in the space of `place` from those that `last` is of.
//   jacobian  d place / d world
//   ray       world direction of unit depth
void enterPlanes(int space, vec3 place, mat3 jacobian, vec3 ray, inout Entered last) {
    vec3 perDepth = jacobian * ray;
    for (int n = space == 0 ? 0 : cutPlaneEnds[space - 1]; n < cutPlaneEnds[space]; ++n) {
        float change = dot(cutPlanes[n].xyz, perDepth);
        float depth = -(dot(cutPlanes[n].xyz, place) + cutPlanes[n].w) / change;
        if (change > 0.0 && depth > last.depth) last = Entered(depth, cutPlanes[n].xyz * jacobian);
    }
}

void enterBox(vec3 index, mat3 jacobian, vec3 ray, inout Entered last) {
    vec3 perDepth = jacobian * ray;
    vec3 safe = mix(perDepth, vec3(1e-20), lessThan(abs(perDepth), vec3(1e-20)));
    vec3 enter = min((cutMin - index) / safe, (cutMax - index) / safe);
    float depth = max(max(enter.x, enter.y), enter.z);
    vec3 axis = enter.x >= depth ? vec3(1.0, 0.0, 0.0) : enter.y >= depth ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
    if (depth > last.depth) last = Entered(depth, axis * jacobian);
}

// The faces of a volume under one map at most.
Entered enteredBefore(vec3 index, mat3 jacobian, vec3 ray) {
    Entered last = Entered(-1e30, vec3(0.0));
    enterBox(index, jacobian, ray, last);
    enterPlanes(0, index, jacobian, ray, last);
    return last;
}

// The face's normal, towards the eye, and how much it counts (w; 0: not at all): it was entered by less than two thicknesses
// before.
vec4 cutBy(Entered face, vec3 ray) {
    float weight = cutThickness > 0.0 ? clamp(2.0 + face.depth * length(ray) / cutThickness, 0.0, 1.0) : 0.0;
    vec3 normal = normalize(face.normal);
    return vec4(dot(normal, ray) > 0.0 ? -normal : normal, weight);
}

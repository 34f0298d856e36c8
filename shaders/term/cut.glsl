// term/cut.glsl: faces that gaps, ends of domains and solids lay bare in data; the twin of core/eval/cut_faces.
// One loop asks where the term's data are, so that compilers put that in place once.
// Needs the generated functions.

uniform float cutThickness;  // world units: so deep behind a cut its normal counts wholly, gone at twice that; 0: no cuts

const int kHalvings = 18;  // of 8 thicknesses

// The normal of a cut, towards the eye, that the ray passed less than two thicknesses before it came to `here`, and how
// much it counts (w; 0: there is none).
//   perLength       change of the place for a unit of length along the ray
//   along           world direction of the ray, unit
//   placeFromWorld  d place / d world
vec4 cutBefore(vec3 here, vec3 perLength, vec3 along, mat3 placeFromWorld) {
    vec3 size = abs(along);
    vec3 axis = size.x <= size.y && size.x <= size.z ? vec3(1.0, 0.0, 0.0)
                                                     : size.y <= size.z ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
    vec3 first = normalize(cross(along, axis));
    vec3 second = cross(along, first);
    vec2 slope = vec2(0.0);
    vec3 from = here;
    float face = 0.0;
    float outer = 0.0;
    float inner = 0.0;
    float shift = 0.0;
    int line = 0;     // the ray itself, then two beside it
    int attempt = 0;  // a side and a distance
    int done = 0;     // of a line
    const int kSearched = 4;
    for (int n = 0; n < 120; ++n) {
        bool halving = done >= kSearched;
        float s;
        if (halving)
            s = 0.5 * (outer + inner);
        else if (line == 0)
            s = -0.5 * cutThickness * float(done + 1);
        else
            s = done == 0 ? outer : inner;
        vec3 p = from + s * perLength;
        bool within = withinBounds(p) && withinTermAt(p);
        if (halving) {
            if (within) inner = s; else outer = s;
            ++done;
        } else if (line == 0) {
            ++done;
            if (!within) {
                outer = s;
                inner = s + 0.5 * cutThickness;
                done = kSearched;
            } else if (done == kSearched) {
                return vec4(0.0);
            }
        } else if (within == (done == 1)) {
            done = done == 0 ? 1 : kSearched;
        } else {
            if (++attempt == 4) return vec4(0.0);
            done = -1;
        }
        if (done == kSearched + kHalvings) {
            s = 0.5 * (outer + inner);
            if (line == 0) face = s; else slope[line - 1] = s / shift;
            if (++line == 3) break;
            attempt = 0;
            done = -1;
        }
        if (done < 0) {
            // Hardly aside, so that edges stay sharp; the farther reach is for faces that are seen nearly from the side.
            shift = (attempt < 2 ? 0.1 : 0.02) * (attempt % 2 == 0 ? cutThickness : -cutThickness);
            from = here + face * perLength + shift * (placeFromWorld * (line == 1 ? first : second));
            outer = (attempt < 2 ? -40.0 : -6.0) * abs(shift);
            inner = -outer;
            done = 0;
        }
    }
    vec3 normal = normalize(cross(first + slope.x * along, second + slope.y * along));
    return vec4(dot(normal, along) > 0.0 ? -normal : normal, clamp(2.0 + face / cutThickness, 0.0, 1.0));
}

// common/volume_cut.glsl: the faces at which a volume's box cuts the data.

uniform float cutThickness;  // world units: so deep behind a cut its normal counts wholly, gone at twice that; 0: no cuts
uniform vec3 cutMin;         // of index coordinates
uniform vec3 cutMax;

// Where cells of a map that are no cut end, nothing is: a face of the box in front of that was never entered.
uniform bool cellsEnd;            // may do so within the box
uniform mat4 sourceFromPlace;     // to where the cells' sources fill a box
uniform vec3 cellsMin;
uniform vec3 cellsMax;
vec3 placeEntered = vec3(0.0);    // the fragment's place, and its change per unit of depth: to be set where cellsEnd
vec3 placePerDepthEntered = vec3(0.0);

// The depth, from the slice, at which the ray last entered the cells' box.
float cellsEntered() {
    vec3 source = (sourceFromPlace * vec4(placeEntered, 1.0)).xyz;
    vec3 change = mat3(sourceFromPlace) * placePerDepthEntered;
    vec3 safe = mix(change, vec3(1e-20), lessThan(abs(change), vec3(1e-20)));
    vec3 enter = min((cellsMin - source) / safe, (cellsMax - source) / safe);
    return max(max(enter.x, enter.y), enter.z);
}

// The world normal of the face that the ray entered by less than two thicknesses before `index`, and how much it counts
// (w; 0: there is none). `depth` is that of `index` from the slice, `ray` is the world direction of unit depth, `jacobian` is d index / d world.
vec4 faceBefore(vec3 index, float depth, mat3 jacobian, vec3 ray) {
    vec3 perDepth = jacobian * ray;
    vec3 safe = mix(perDepth, vec3(1e-20), lessThan(abs(perDepth), vec3(1e-20)));
    vec3 enter = min((cutMin - index) / safe, (cutMax - index) / safe);
    float nearest = max(max(enter.x, enter.y), enter.z);
    float weight = cutThickness > 0.0 ? clamp(2.0 + nearest * length(ray) / cutThickness, 0.0, 1.0) : 0.0;
    // The cells' own box may be the volume's.
    if (cellsEnd && (cellsEntered() - depth - nearest) * length(ray) > 0.05 * cutThickness) weight = 0.0;
    vec3 axis = enter.x >= nearest ? vec3(1.0, 0.0, 0.0) : enter.y >= nearest ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
    vec3 normal = normalize(axis * jacobian);
    return vec4(dot(normal, ray) > 0.0 ? -normal : normal, weight);
}

// common/volume_cut.glsl: the faces at which a volume's box cuts the data.

uniform float cutThickness;  // world units: so deep behind a cut its normal counts wholly, gone at twice that; 0: no cuts
uniform vec3 cutMin;         // of index coordinates
uniform vec3 cutMax;

// The world normal of the face that the ray entered by less than two thicknesses before `index`, and how much it counts
// (w; 0: there is none). `ray` is the world direction of unit depth, `jacobian` is d index / d world.
vec4 faceBefore(vec3 index, mat3 jacobian, vec3 ray) {
    vec3 perDepth = jacobian * ray;
    vec3 safe = mix(perDepth, vec3(1e-20), lessThan(abs(perDepth), vec3(1e-20)));
    vec3 enter = min((cutMin - index) / safe, (cutMax - index) / safe);
    float nearest = max(max(enter.x, enter.y), enter.z);
    float weight = cutThickness > 0.0 ? clamp(2.0 + nearest * length(ray) / cutThickness, 0.0, 1.0) : 0.0;
    vec3 axis = enter.x >= nearest ? vec3(1.0, 0.0, 0.0) : enter.y >= nearest ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
    vec3 normal = normalize(axis * jacobian);
    return vec4(dot(normal, ray) > 0.0 ? -normal : normal, weight);
}

// common/cut_normal.glsl: how the normal of a cut and that of the data behind it become one.

// The world gradient that shades.
//   cut  the cut's normal, and how much it counts
vec3 withCut(vec4 cut, vec3 gradient) {
    if (!(cut.w > 0.0)) return gradient;
    float largest = max(max(abs(gradient.x), abs(gradient.y)), abs(gradient.z));
    vec3 scaled = gradient / largest;
    float steepness = length(scaled);
    if (cut.w >= 1.0 || !(steepness > 0.0)) return cut.xyz;
    vec3 own = scaled / (dot(scaled, cut.xyz) < 0.0 ? -steepness : steepness);
    return mix(own, cut.xyz, cut.w);
}

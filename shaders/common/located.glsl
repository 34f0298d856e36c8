// common/located.glsl: forward maps below the one whose cells are cut. A point is located in the tetrahedra of one map
// after the other, the first that holds it. Needs common/volume.glsl,
// volume_cut.glsl, cell_search.glsl.

const int kMostLocated = 8;  // SlicePlan has the same
uniform int locatedCount;

uint[kMostLocated] noHints() {
    uint hint[kMostLocated];
    for (int m = 0; m < kMostLocated; ++m) hint[m] = kNowhere;
    return hint;
}

// Index coordinates of a point; false where a map or the volume has none.
// hint      the tetrahedra found last
// jacobian  d point / d world; becomes d index / d world
// faces     whether `last` becomes the face that the ray, whose world direction of unit depth is `ray`, entered last before
bool locate(vec3 point, inout uint hint[kMostLocated], out vec3 index, inout mat3 jacobian, vec3 ray, out Entered last, bool faces) {
    index = point;
    last = Entered(-1e30, vec3(0.0));
    if (faces) enterPlanes(0, point, jacobian, ray, last);
    for (int m = 0; m < locatedCount; ++m) {
        vec4 weight;
        if (findTetrahedron(locatedMaps[m].grid, point, hint[m], weight)) {
            weight = clamped(weight);
            uvec4 vertex = 3u * locatedCorners[hint[m]];
            vec4 a = vec4(0.0), b = vec4(0.0), c = vec4(0.0);
            for (int n = 0; n < 4; ++n) {
                a += weight[n] * locatedVertices[vertex[n]];
                b += weight[n] * locatedVertices[vertex[n] + 1u];
                c += weight[n] * locatedVertices[vertex[n] + 2u];
            }
            point = a.xyz;
            jacobian = mat3(vec3(a.w, b.xy), vec3(b.zw, c.x), c.yzw) * jacobian;
            if (faces) enterPlanes(m + 1, point, jacobian, ray, last);
        } else if (locatedMaps[m].keeps.x != 0) {
            point = (locatedMaps[m].nextFromThis * vec4(point, 1.0)).xyz;
            jacobian = mat3(locatedMaps[m].nextFromThis) * jacobian;
        } else {
            return false;
        }
    }
    index = point;
    if (faces) enterBox(index, jacobian, ray, last);
    return insideVolume(index);
}

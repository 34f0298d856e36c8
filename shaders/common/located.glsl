// common/located.glsl: forward maps below the one whose cells are cut. A point is located in the tetrahedra of one map
// after the other, the first that holds it; arrays and spaces are those of render/located_maps.h.
// Needs common/volume.glsl.

const int kMostLocated = 8;  // SlicePlan has the same
const uint kNowhere = 0xffffffffu;

struct LocatedMap {
    mat4 nextFromThis;
    ivec4 grid;   // cells along each axis; where its starts begin
    ivec4 keeps;  // x = 1: outside its cells points stay
};
layout(std430, binding = 0) readonly buffer LocatedMapBuffer { LocatedMap locatedMaps[]; };
layout(std430, binding = 1) readonly buffer LocatedCellBuffer { uint locatedCells[]; };
layout(std430, binding = 2) readonly buffer LocatedTetrahedronBuffer { vec4 locatedTetrahedra[]; };  // four each
layout(std430, binding = 3) readonly buffer LocatedCornerBuffer { uvec4 locatedCorners[]; };
layout(std430, binding = 4) readonly buffer LocatedVertexBuffer { vec4 locatedVertices[]; };  // three each
uniform int locatedCount;

uint[kMostLocated] noHints() {
    uint hint[kMostLocated];
    for (int m = 0; m < kMostLocated; ++m) hint[m] = kNowhere;
    return hint;
}

bool holds(uint tetrahedron, vec3 point, out vec4 weight) {
    vec4 origin = locatedTetrahedra[4u * tetrahedron];
    vec4 rate1 = locatedTetrahedra[4u * tetrahedron + 1u];
    vec4 rate2 = locatedTetrahedra[4u * tetrahedron + 2u];
    vec4 rate3 = locatedTetrahedra[4u * tetrahedron + 3u];
    vec3 edge = point - origin.xyz;
    weight.yzw = vec3(dot(rate1.xyz, edge), dot(rate2.xyz, edge), dot(rate3.xyz, edge));
    weight.x = 1.0 - weight.y - weight.z - weight.w;
    return all(greaterThanEqual(weight, -vec4(origin.w, rate1.w, rate2.w, rate3.w)));
}

// `found` is tried first, as neighbouring points mostly share a tetrahedron; maps do not overlap, so another one could
// hold the point on a common face only.
bool findTetrahedron(ivec4 grid, vec3 point, inout uint found, out vec4 weight) {
    if (found != kNowhere && holds(found, point, weight)) return true;
    vec3 size = vec3(grid.xyz);
    if (any(lessThan(point, -1e-3 * size)) || any(greaterThan(point, 1.001 * size))) return false;
    ivec3 cell = clamp(ivec3(floor(point)), ivec3(0), grid.xyz - 1);
    int start = grid.w + cell.x + grid.x * (cell.y + grid.y * cell.z);
    uint end = locatedCells[start + 1];
    for (uint n = locatedCells[start]; n < end; ++n) {
        uint tetrahedron = locatedCells[n];
        if (holds(tetrahedron, point, weight)) {
            found = tetrahedron;
            return true;
        }
    }
    return false;
}

// Index coordinates of a point; false where a map or the volume has none.
// hint      the tetrahedra found last
// jacobian  d point / d world; becomes d index / d world
bool locate(vec3 point, inout uint hint[kMostLocated], out vec3 index, inout mat3 jacobian) {
    index = point;
    for (int m = 0; m < locatedCount; ++m) {
        vec4 weight;
        if (findTetrahedron(locatedMaps[m].grid, point, hint[m], weight)) {
            weight = max(weight, 0.0);
            weight /= weight.x + weight.y + weight.z + weight.w;
            uvec4 vertex = 3u * locatedCorners[hint[m]];
            vec4 a = vec4(0.0), b = vec4(0.0), c = vec4(0.0);
            for (int n = 0; n < 4; ++n) {
                a += weight[n] * locatedVertices[vertex[n]];
                b += weight[n] * locatedVertices[vertex[n] + 1u];
                c += weight[n] * locatedVertices[vertex[n] + 2u];
            }
            point = a.xyz;
            jacobian = mat3(vec3(a.w, b.xy), vec3(b.zw, c.x), c.yzw) * jacobian;
        } else if (locatedMaps[m].keeps.x != 0) {
            point = (locatedMaps[m].nextFromThis * vec4(point, 1.0)).xyz;
            jacobian = mat3(locatedMaps[m].nextFromThis) * jacobian;
        } else {
            return false;
        }
    }
    index = point;
    return insideVolume(index);
}

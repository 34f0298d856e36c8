// common/cell_search.glsl: finds points in the tetrahedra of forward maps; arrays and spaces are those of
// render/cell_arrays.h. Points come in grid coordinates, units of a map's grid of lists.

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

// Whether a map's grid holds the point (a little more, as single precision rounds), and which list is its.
bool listOf(ivec4 grid, vec3 point, out int list) {
    vec3 size = vec3(grid.xyz);
    ivec3 cell = clamp(ivec3(floor(point)), ivec3(0), grid.xyz - 1);
    list = grid.w + cell.x + grid.x * (cell.y + grid.y * cell.z);
    return all(greaterThanEqual(point, -1e-3 * size)) && all(lessThanEqual(point, 1.001 * size));
}

// `found` is tried first, as neighbouring points mostly share a tetrahedron: only for maps that do not overlap, where
// another one could hold the point on a common face only.
bool findTetrahedron(ivec4 grid, vec3 point, inout uint found, out vec4 weight) {
    if (found != kNowhere && holds(found, point, weight)) return true;
    int list;
    if (!listOf(grid, point, list)) return false;
    uint end = locatedCells[list + 1];
    for (uint n = locatedCells[list]; n < end; ++n) {
        uint tetrahedron = locatedCells[n];
        if (holds(tetrahedron, point, weight)) {
            found = tetrahedron;
            return true;
        }
    }
    return false;
}

// Weights of the nearby point that is in the tetrahedron.
vec4 clamped(vec4 weight) {
    weight = max(weight, 0.0);
    return weight / (weight.x + weight.y + weight.z + weight.w);
}

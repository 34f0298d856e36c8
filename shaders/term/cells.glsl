// term/cells.glsl: mapped cells of a generated program. Needs common/cell_search.glsl, term/numbers.glsl.
//   map    which of render/cell_arrays.h
//   grid   three groups: grid coordinates of p
//   hint   the tetrahedron found last, or kNowhere
// Vertices hold q and d q / d p; those of meshes a value and its gradient.

bool foundIn(int map, int grid, vec3 p, inout uint hint, out vec4 weight) {
    bool found = findTetrahedron(locatedMaps[map].grid, placed(grid, p), hint, weight);
    weight = found ? clamped(weight) : vec4(0.0);
    return found;
}

vec3 sourceIn(uint tetrahedron, vec4 weight) {
    uvec4 vertex = 3u * locatedCorners[tetrahedron];
    return weight.x * locatedVertices[vertex.x].xyz + weight.y * locatedVertices[vertex.y].xyz +
           weight.z * locatedVertices[vertex.z].xyz + weight.w * locatedVertices[vertex.w].xyz;
}

mat3 jacobianIn(uint tetrahedron, vec4 weight) {
    uvec4 vertex = 3u * locatedCorners[tetrahedron];
    mat3x4 sum = mat3x4(0.0);
    for (int n = 0; n < 4; ++n)
        sum += weight[n] * mat3x4(locatedVertices[vertex[n]], locatedVertices[vertex[n] + 1u],
                                  locatedVertices[vertex[n] + 2u]);
    return mat3(vec3(sum[0].w, sum[1].xy), vec3(sum[1].zw, sum[2].x), sum[2].yzw);
}

bool cellsMapped(int map, int grid, bool keep, vec3 p, inout uint hint, out vec3 q) {
    vec4 weight;
    bool found = foundIn(map, grid, p, hint, weight);
    q = found ? sourceIn(found ? hint : 0u, weight) : p;
    return found || keep;
}

bool litCellsMapped(int map, int grid, bool keep, vec3 p, inout uint hint, out vec3 q, out mat3 j) {
    vec4 weight;
    bool found = foundIn(map, grid, p, hint, weight);
    uint at = found ? hint : 0u;
    q = found ? sourceIn(at, weight) : p;
    j = found ? jacobianIn(at, weight) : mat3(1.0);
    return found || keep;
}

// Value (x) and gradient of a mesh; undefined and 0 outside.
vec4 meshAt(int map, int grid, vec3 p, inout uint hint) {
    vec4 weight;
    bool found = foundIn(map, grid, p, hint, weight);
    uvec4 vertex = 3u * locatedCorners[found ? hint : 0u];
    vec4 sum = vec4(0.0);
    for (int n = 0; n < 4; ++n) sum += weight[n] * locatedVertices[vertex[n]];
    return found ? sum : vec4(undefinedValue(), vec3(0.0));
}

// All pre-images of p in a map that lies upon itself, as far as there is room: those of one source point once.
const int kMostPreImages = 8;
struct PreImages {
    int count;
    uint tetrahedron[kMostPreImages];
    vec4 weight[kMostPreImages];
    vec3 source[kMostPreImages];
};

//   slack  a group: how far apart the sources of one point may come out, in x
void findPreImages(int map, int grid, int slack, vec3 p, out PreImages found) {
    found.count = 0;
    vec3 point = placed(grid, p);
    int list;
    if (!listOf(locatedMaps[map].grid, point, list)) return;
    uint end = locatedCells[list + 1];
    for (uint n = locatedCells[list]; n < end && found.count < kMostPreImages; ++n) {
        uint tetrahedron = locatedCells[n];
        vec4 weight;
        if (!holds(tetrahedron, point, weight)) continue;
        weight = clamped(weight);
        vec3 source = sourceIn(tetrahedron, weight);
        bool again = false;
        for (int k = 0; k < found.count; ++k) again = again || distance(source, found.source[k]) <= quad(slack).x;
        if (again) continue;
        found.tetrahedron[found.count] = tetrahedron;
        found.weight[found.count] = weight;
        found.source[found.count] = source;
        ++found.count;
    }
}

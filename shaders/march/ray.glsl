// march/ray.glsl: the view ray of a fragment, in steps from where it enters the box of places. Needs common/volume.glsl.

uniform mat3 rayPerDepth;       // world direction of unit depth: [0] + x [1] + y [2], x and y the window position
uniform mat3 placeAtReference;  // its place at the reference depth, the same way
uniform mat3 placePerDepth;
uniform float eyeDepth;         // less the reference depth
uniform vec3 boxMin;            // where there are places
uniform vec3 boxMax;
uniform vec3 visibleMin;        // nothing is seen outside
uniform vec3 visibleMax;
uniform float stepLength;       // world units
uniform float opacityDistance;  // world units
uniform mat3 indexFromWorld;    // linear part

uniform usampler3D distances;  // of cells: how many away the next one is that can be seen, at most
uniform vec3 cellsPerPlace;

struct Ray {
    vec3 direction;  // world, unit depth
    vec3 start;      // place at u = 0
    vec3 perStep;
    vec3 inverse;    // steps a cell
    float first;     // u: a whole number before anything can be seen; BAKED: of whole blocks, and one more before …
    float last;      // … and where that ends
    float end;       // where the ray leaves the box
    float unit;      // opacity distances a step
    float depth;     // at u = 0, from the reference
    float depthPerStep;
};

// Where start + t * perUnit is within a box: from x to y.
vec2 crossings(vec3 start, vec3 perUnit, vec3 low, vec3 high) {
    vec3 inverse = 1.0 / perUnit;
    vec3 one = (low - start) * inverse;
    vec3 other = (high - start) * inverse;
    vec3 enter = min(one, other);
    vec3 leave = max(one, other);
    return vec2(max(max(enter.x, enter.y), enter.z), min(min(leave.x, leave.y), leave.z));
}

vec3 notZero(vec3 v) {
    return mix(v, vec3(1e-20), lessThan(abs(v), vec3(1e-20)));
}

Ray viewRay(vec2 window) {
    vec3 at = vec3(1.0, window);
    Ray ray;
    ray.direction = rayPerDepth * at;
    vec3 reference = placeAtReference * at;
    vec3 perDepth = notZero(placePerDepth * at);
    float stepDepth = stepLength / length(ray.direction);
    vec2 box = crossings(reference, perDepth, boxMin, boxMax);
    vec2 visible = crossings(reference, perDepth, visibleMin, visibleMax);
    box.x = max(box.x, eyeDepth);
    ray.start = reference + box.x * perDepth;
    ray.perStep = stepDepth * perDepth;
    ray.inverse = 1.0 / (ray.perStep * cellsPerPlace);
    ray.end = (box.y - box.x) / stepDepth;
#ifdef BAKED
    ray.first = max(floor((visible.x - box.x) / (stepDepth * float(STEPS))) - 1.0, -1.0) * float(STEPS);
#else
    ray.first = max(floor((visible.x - box.x) / stepDepth), 0.0);
#endif
    ray.last = min((visible.y - box.x) / stepDepth, ray.end);
    if (!(visible.x < visible.y)) ray.last = ray.first;
    ray.unit = stepLength / opacityDistance;
    ray.depth = box.x;
    ray.depthPerStep = stepDepth;
    return ray;
}

// The last step from u on before one that has to be looked at, or the ray's end. A cell's distance tells of all cells about
// it up to that, so the ray goes on to where it leaves these. BAKED: in whole blocks, less one, whose end the next begins with.
float stride(Ray ray, float u) {
    vec3 lastCell = vec3(textureSize(distances, 0) - 1);
    while (u < ray.last) {
        vec3 at = (ray.start + u * ray.perStep) * cellsPerPlace;
        vec3 cell = clamp(floor(at), vec3(0.0), lastCell);
        float distance = float(texelFetch(distances, ivec3(cell), 0).r);
        vec3 leave = (cell + 0.5 - at) * ray.inverse + (distance - 0.5) * abs(ray.inverse);
        // A little less, for rounding.
        float steps = min(min(leave.x, leave.y), leave.z) - 0.001;
#ifdef BAKED
        steps = (floor(steps / float(STEPS)) - 1.0) * float(STEPS);
#else
        steps = floor(steps);
#endif
        // A single step is not worth a new beginning.
        if (distance == 0.0 || steps < min(2.0, float(STEPS))) break;
        u += steps;
    }
    return u;
}

#ifdef BAKED
uniform sampler3D map;        // index coordinates at the nodes of a grid, and 1 where they are known
uniform vec3 mapTexel;        // 1 / its nodes
uniform float known;          // from which on the map holds
uniform sampler3D jacobianX;  // d index / d world, its columns, at every second node
uniform sampler3D jacobianY;
uniform sampler3D jacobianZ;
uniform vec3 jacobianTexel;
#endif

// A block's way through the volume: straight, by steps; BAKED: from its beginning, else from u = 0 on, so that places do
// not depend on where blocks begin.
struct Line {
    vec3 index;   // index coordinates at 0
    vec3 change;  // a step
#ifdef BAKED
    vec4 end;     // index coordinates there, and 1 where they are known
#endif
};

Line noLine() {
#ifdef BAKED
    return Line(vec3(0.0), vec3(0.0), vec4(0.0));
#else
    return Line(vec3(0.0), vec3(0.0));
#endif
}

vec3 indexOn(Line line, float steps) {
    return line.index + steps * line.change;
}

// Where on its line the block at u begins.
float blockBegin(float u) {
#ifdef BAKED
    return 0.0;
#else
    return u;
#endif
}

// The line of the block at u, after that of the block before. Gives from which step on and up to which it lies in the
// volume.
vec2 nextLine(Ray ray, float u, inout Line line) {
    float count = min(ray.end - u, float(STEPS));
#ifdef BAKED
    vec4 from = line.end;
    line.end = textureLod(map, (ray.start + (u + count) * ray.perStep + 0.5) * mapTexel, 0.0);
    line.index = from.xyz;
    line.change = (line.end.xyz - from.xyz) / max(count, 1e-6);
    vec2 within = crossings(line.index, notZero(line.change), domainMin, domainMax);
    within = vec2(max(within.x, 0.0), min(within.y, count));
    return min(from.w, line.end.w) > known && within.x < within.y ? within : vec2(count);
#else
    line.index = ray.start;
    line.change = ray.perStep;
    return vec2(u, u + count);
#endif
}

// d index / d world at u.
mat3 indexJacobian(Ray ray, float u) {
#ifdef BAKED
    vec3 at = (0.5 * (ray.start + u * ray.perStep) + 0.5) * jacobianTexel;
    return mat3(textureLod(jacobianX, at, 0.0).xyz, textureLod(jacobianY, at, 0.0).xyz, textureLod(jacobianZ, at, 0.0).xyz);
#else
    return indexFromWorld;
#endif
}

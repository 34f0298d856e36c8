// common/surroundings.glsl: what stands around a point takes of its light, looked up in grids over the whole scene; the twin
// of core/eval/surroundings. "Grid" coordinates count cells of its opacity.
// Without SURROUNDINGS nothing takes any.
// Needs common/lighting.glsl.

#ifdef SURROUNDINGS
uniform sampler3D gridAlpha;  // alpha of one cell's length; levels hold means
uniform usampler3D gridClearance;  // of bricks of 4³ cells: 0, or how many bricks around are clear
uniform sampler3D gridOpenness;    // openness times weight, and weight, at every second cell's corner
uniform sampler3D lightLeft;       // of the first light, where it comes from afar: by its rays
uniform vec3 gridSize;             // cells
uniform vec3 opennessTexel;        // texture coordinates of gridOpenness for a cell
uniform mat4 lightFromGrid;        // texture coordinates of lightLeft, of where light for a place is looked up
uniform mat3 gridAtReference;  // grid coordinates at the reference depth by the window position: [0] + x [1] + y [2]
uniform mat3 gridPerDepth;    // their change per unit of depth
uniform float shadowStrength;
uniform float occlusionStrength;

const float kLift = 1.5;
const float kStart = 1.0;
const float kDark = 1.0 / 256.0;

float gridAlphaAt(vec3 at, float level) {
    return textureLod(gridAlpha, at / gridSize, level).r;
}

vec3 outwardAt(vec3 at) {
    vec3 reach = vec3(1.5, 0.0, 0.0);
    vec3 ahead = vec3(gridAlphaAt(at + reach.xyz, 1.0), gridAlphaAt(at + reach.zxy, 1.0), gridAlphaAt(at + reach.yzx, 1.0));
    vec3 behind = vec3(gridAlphaAt(at - reach.xyz, 1.0), gridAlphaAt(at - reach.zxy, 1.0), gridAlphaAt(at - reach.yzx, 1.0));
    vec3 difference = behind - ahead;
    float len = length(difference);
    if (!(len > 0.0)) return vec3(0.0);
    float sum = dot(ahead + behind, vec3(1.0));
    return difference * (min(len / (0.4 * sum / 6.0), 1.0) / len);
}

float lightThrough(vec3 at, vec3 toward) {
    vec3 inverse = 1.0 / mix(toward, vec3(1e-20), lessThan(abs(toward), vec3(1e-20)));
    float left = 1.0;
    float s = kStart + 0.5;
    for (int n = 0; n < 2048 && left > kDark; ++n) {
        vec3 x = at + s * toward;
        if (any(lessThanEqual(x, vec3(0.0))) || any(greaterThanEqual(x, gridSize))) break;
        ivec3 brick = ivec3(x) / 4;
        float clear = float(texelFetch(gridClearance, brick, 0).r);
        if (clear > 0.0) {
            vec3 face = 4.0 * (vec3(brick) + mix(vec3(1.0 - clear), vec3(clear), greaterThan(toward, vec3(0.0))));
            vec3 leave = mix((face - x) * inverse, vec3(1e30), equal(toward, vec3(0.0)));
            s += max(ceil(min(min(leave.x, leave.y), leave.z)), 1.0);
            continue;
        }
        left *= 1.0 - gridAlphaAt(x, 0.0);
        s += 1.0;
    }
    return left > kDark ? left : 0.0;
}

float opennessAt(vec3 at) {
    vec2 open = textureLod(gridOpenness, at * opennessTexel, 0.0).rg;
    return open.y > 0.0 ? open.x / open.y : 1.0;
}

float firstLightAt(vec3 at, vec3 toEye) {
    if (lightKind == 0) return lightThrough(at, toEye);
    return textureLod(lightLeft, (lightFromGrid * vec4(at, 1.0)).xyz, 0.0).r;
}
#endif

// What is left of the first light (x) and of the light from everywhere (y), at a depth from the reference.
vec2 lightShareAt(float depth, vec3 ray) {
    vec2 share = vec2(1.0);
#ifdef SURROUNDINGS
    vec3 window = vec3(1.0, gl_FragCoord.xy);
    vec3 here = gridAtReference * window + depth * (gridPerDepth * window);
    vec3 lifted = here + kLift * outwardAt(here);
    if (shadowStrength > 0.0) share.x -= shadowStrength * (1.0 - firstLightAt(lifted, -normalize(ray)));
    if (occlusionStrength > 0.0) share.y -= occlusionStrength * (1.0 - opennessAt(lifted));
#endif
    return share;
}

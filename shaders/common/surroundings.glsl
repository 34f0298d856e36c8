// common/surroundings.glsl: what stands around a point takes of its light, by marching through a grid of the scene's
// opacity; the twin of core/eval/surroundings. "Grid" coordinates count cells.
// Without SURROUNDINGS nothing takes any.
// Needs common/slice_input.glsl and common/lighting.glsl.

#ifdef SURROUNDINGS
uniform sampler3D gridAlpha;  // alpha of one cell's length; levels hold means
uniform usampler3D gridClearance;  // of bricks of 4³ cells: 0, or how many bricks around are clear
uniform vec3 gridSize;        // cells
uniform mat3 gridAtReference;  // grid coordinates at the reference depth by the window position: [0] + x [1] + y [2]
uniform mat3 gridPerDepth;    // their change per unit of depth
uniform float shadowStrength;
uniform float occlusionStrength;
uniform vec3 occlusionDirections[32];
uniform vec4 occlusionStretches[5];  // middle, length, level, how much counts

const float kLift = 1.5;
const float kStart = 1.0;
const float kDark = 1.0 / 256.0;
const float kFlattest = 0.3;

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

float opennessAt(vec3 at, vec3 outward) {
    float clear = length(outward);
    float open = 0.0;
    float weights = 0.0;
    for (int d = 0; d < 32; ++d) {
        float weight = dot(occlusionDirections[d], outward) - kFlattest * clear + (1.0 - clear);
        if (!(weight > 0.0)) continue;
        float left = 1.0;
        float taken = 0.0;
        for (int n = 0; n < 5; ++n) {
            vec4 stretch = occlusionStretches[n];
            float alpha = gridAlphaAt(at + stretch.x * occlusionDirections[d], stretch.z);
            float next = left * pow(1.0 - alpha, stretch.y);
            taken += (left - next) * stretch.w;
            left = next;
        }
        open += weight * (1.0 - taken);
        weights += weight;
    }
    return weights > 0.0 ? open / weights : 1.0;
}
#endif

// What is left of the first light (x) and of the light from everywhere (y), at a depth from the slice, for a share
// `alpha` of what is seen.
vec2 lightShare(float depth, float alpha, vec3 ray) {
    vec2 share = vec2(1.0);
#ifdef SURROUNDINGS
    if (alpha > 1e-4) {
        vec3 window = vec3(1.0, gl_FragCoord.xy);
        vec3 here = gridAtReference * window + (sliceDepth + depth) * (gridPerDepth * window);
        vec3 outward = outwardAt(here);
        vec3 lifted = here + kLift * outward;
        if (shadowStrength > 0.0)
            share.x -= shadowStrength * (1.0 - lightThrough(lifted, towardFirst(-normalize(ray))));
        if (occlusionStrength > 0.0) share.y -= occlusionStrength * (1.0 - opennessAt(lifted, outward));
    }
#endif
    return share;
}

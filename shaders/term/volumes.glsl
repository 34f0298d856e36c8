// term/volumes.glsl: volumes by index coordinates, where samples stand at whole numbers; the definitions of
// core/fields/volume.h.
//   scale  a group of numbers: value = raw * x + y

vec3 sizeOf(sampler3D grid) {
    return vec3(textureSize(grid, 0));
}

// An axis of one sample is one voxel thick; a thousandth of a voxel outside counts as inside.
bool insideGrid(sampler3D grid, vec3 index) {
    vec3 last = sizeOf(grid) - 1.0;
    vec3 reach = mix(vec3(0.001), vec3(0.501), lessThan(last, vec3(0.5)));
    return all(greaterThanEqual(index, -reach)) && all(lessThanEqual(index, last + reach));
}

float linearRaw(sampler3D grid, vec3 index) {
    return textureLod(grid, (index + 0.5) / sizeOf(grid), 0.0).r;
}

float linearValue(sampler3D grid, int scale, vec3 index) {
    float value = linearRaw(grid, index) * quad(scale).x + quad(scale).y;
    return insideGrid(grid, index) ? value : undefinedValue();
}

// d value / d index, by differences of one voxel, one-sided at the faces.
vec3 linearGradient(sampler3D grid, int scale, vec3 index) {
    vec3 last = sizeOf(grid) - 1.0;
    vec3 at = clamp(index, vec3(0.0), last);
    vec3 ahead = min(at + 1.0, last);
    vec3 behind = max(at - 1.0, vec3(0.0));
    vec3 difference = vec3(linearRaw(grid, vec3(ahead.x, at.yz)) - linearRaw(grid, vec3(behind.x, at.yz)),
                           linearRaw(grid, vec3(at.x, ahead.y, at.z)) - linearRaw(grid, vec3(at.x, behind.y, at.z)),
                           linearRaw(grid, vec3(at.xy, ahead.z)) - linearRaw(grid, vec3(at.xy, behind.z)));
    return difference / max(ahead - behind, vec3(1e-6)) * quad(scale).x;
}

float nearestValue(sampler3D grid, int scale, vec3 index) {
    vec3 last = sizeOf(grid) - 1.0;
    float raw = texelFetch(grid, ivec3(clamp(index, vec3(0.0), last) + 0.5), 0).r;
    return insideGrid(grid, index) ? raw * quad(scale).x + quad(scale).y : undefinedValue();
}

vec3 nearestGradient(sampler3D grid, int scale, vec3 index) {
    return linearGradient(grid, scale, index);
}

// One axis of the uniform cubic B-spline at x, as two linear fetches: places and weights.
void splinePlaces(float x, float last, out vec2 place, out vec2 weight) {
    float below = min(floor(x), last);
    float f = x - below;
    float g = 1.0 - f;
    vec4 w = vec4(g * g * g, 4.0 - 3.0 * f * f * (2.0 - f), 4.0 - 3.0 * g * g * (2.0 - g), f * f * f) / 6.0;
    weight = vec2(w.x + w.y, w.z + w.w);
    place = below + vec2(w.y / weight.x - 1.0, w.w / weight.y + 1.0);
}

float cubicRaw(sampler3D grid, vec3 index) {
    vec3 last = sizeOf(grid) - 1.0;
    vec3 at = clamp(index, vec3(0.0), last);
    vec2 x, y, z, u, v, w;
    splinePlaces(at.x, last.x, x, u);
    splinePlaces(at.y, last.y, y, v);
    splinePlaces(at.z, last.z, z, w);
    float sum = 0.0;
    for (int n = 0; n < 8; ++n) {
        ivec3 c = ivec3(n & 1, n >> 1 & 1, n >> 2);
        sum += u[c.x] * v[c.y] * w[c.z] * linearRaw(grid, vec3(x[c.x], y[c.y], z[c.z]));
    }
    return sum;
}

float cubicValue(sampler3D grid, int scale, vec3 index) {
    float value = cubicRaw(grid, index) * quad(scale).x + quad(scale).y;
    return insideGrid(grid, index) ? value : undefinedValue();
}

// Weights' derivatives of one axis.
vec4 splineSlopes(float x, float last) {
    float f = x - min(floor(x), last);
    float g = 1.0 - f;
    return last < 0.5 ? vec4(0.0)
                      : vec4(-0.5 * g * g, 0.5 * f * (3.0 * f - 4.0), 0.5 * g * (4.0 - 3.0 * g), 0.5 * f * f);
}
vec4 splineWeights(float x, float last) {
    float f = x - min(floor(x), last);
    float g = 1.0 - f;
    return vec4(g * g * g, 4.0 - 3.0 * f * f * (2.0 - f), 4.0 - 3.0 * g * g * (2.0 - g), f * f * f) / 6.0;
}

vec3 cubicGradient(sampler3D grid, int scale, vec3 index) {
    vec3 last = sizeOf(grid) - 1.0;
    vec3 at = clamp(index, vec3(0.0), last);
    vec4 u = splineWeights(at.x, last.x), v = splineWeights(at.y, last.y), w = splineWeights(at.z, last.z);
    vec4 du = splineSlopes(at.x, last.x), dv = splineSlopes(at.y, last.y), dw = splineSlopes(at.z, last.z);
    ivec3 first = ivec3(at) - 1;
    vec3 sum = vec3(0.0);
    for (int n = 0; n < 64; ++n) {
        ivec3 c = ivec3(n & 3, n >> 2 & 3, n >> 4);
        float raw = texelFetch(grid, clamp(first + c, ivec3(0), ivec3(last)), 0).r;
        sum += raw * vec3(du[c.x] * v[c.y] * w[c.z], u[c.x] * dv[c.y] * w[c.z], u[c.x] * v[c.y] * dw[c.z]);
    }
    return sum * quad(scale).x;
}

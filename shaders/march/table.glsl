// march/table.glsl: a transfer function integrated over the value (render/march_table.h).

uniform sampler1D nextTable;        // of each bin: the first from it on that absorbs
uniform sampler1D depthTable;       // the antiderivative of extinction in two parts; the extinction
uniform sampler1DArray colorTable;  // row 0: the antiderivative of colour times extinction; row 1: colours
uniform float tableScale;           // bin = raw * tableScale + tableOffset, rounded
uniform float tableOffset;
uniform float tableLast;

// Bins between which colours change little, and over which a difference of two sums may be lost in their rounding.
const int kFewBins = 48;

#ifdef REAL_VOXELS
// By the bits, as compilers may take it for granted that nothing is NaN.
bool isNumber(float raw) {
    return (floatBitsToUint(raw) & 0x7f800000u) != 0x7f800000u;
}
#endif

int binOf(float raw) {
    return int(clamp(raw * tableScale + tableOffset, 0.0, tableLast) + 0.5);
}

// False only if nothing between two bins absorbs.
bool mayAbsorb(int low, int high) {
    return texelFetch(nextTable, low, 0).r <= float(high);
}

// Colour and mean extinction of a stretch over which the value runs from bin `a` to bin `b`.
// ends  extinction there
vec4 between(int a, int b, out vec2 ends) {
    vec3 from = texelFetch(depthTable, a, 0).xyz;
    vec3 to = texelFetch(depthTable, b, 0).xyz;
    vec3 glow = texelFetch(colorTable, ivec2(b, 0), 0).rgb - texelFetch(colorTable, ivec2(a, 0), 0).rgb;
    vec3 middle = texelFetch(colorTable, ivec2((a + b) / 2, 1), 0).rgb;
    // Differences of the leading parts are exact where they are close.
    float depth = (to.x - from.x) + (to.y - from.y);
    ends = vec2(from.z, to.z);
    return vec4(abs(b - a) > kFewBins ? clamp(glow / depth, 0.0, 1.0) : middle, a == b ? from.z : depth / float(b - a));
}

// common/classification.glsl: the transfer function's tables, linear between entries.

uniform sampler1D thicknessTable;  // optical thickness of one opacity distance
uniform sampler1D colorTable;
uniform float tableScale;   // entry = raw * tableScale + tableOffset
uniform float tableOffset;
uniform float tableSize;
uniform vec2 visibleEntries;  // none below the first nor above the second has a thickness above 0

float entryOf(float raw) {
    return clamp(raw * tableScale + tableOffset, 0.0, tableSize - 1.0);
}

#ifdef REAL_VOXELS
// By the bits, as compilers may take it for granted that nothing is NaN.
bool isNumber(float raw) {
    return (floatBitsToUint(raw) & 0x7f800000u) != 0x7f800000u;
}
#endif

float thicknessAt(float entry) {
    return textureLod(thicknessTable, (entry + 0.5) / tableSize, 0.0).r;
}

vec3 colorAt(float entry) {
    return textureLod(colorTable, (entry + 0.5) / tableSize, 0.0).rgb;
}

#ifdef GRADIENT_OPACITY
uniform sampler1D gradientTable;
uniform float gradientScale;  // entry = magnitude * gradientScale

float gradientFactor(float magnitude) {
    float entry = min(magnitude * gradientScale, tableSize - 1.0);
    return textureLod(gradientTable, (entry + 0.5) / tableSize, 0.0).r;
}
#endif

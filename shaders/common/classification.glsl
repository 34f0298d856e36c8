// common/classification.glsl: the transfer function's tables, linear between entries.

uniform sampler1D thicknessTable;  // r: optical thickness of one opacity distance; g: its integral over entries
uniform sampler1D colorTable;
uniform float tableScale;   // entry = raw * tableScale + tableOffset
uniform float tableOffset;
uniform float tableSize;

float entryOf(float raw) {
    // Not a number: an entry that is none, whose thickness is taken as 0 below.
    return clamp(raw * tableScale + tableOffset, 0.0, tableSize - 1.0);
}

vec2 thicknessAt(float entry) {
    return textureLod(thicknessTable, (entry + 0.5) / tableSize, 0.0).rg;
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

// term/numbers.glsl: the numbers of a generated program, in groups of four, and what reads them. Generated functions name
// groups by constant indices, so that the text of a program does not depend on any number.
// Points are world points less one origin that all functions share (render/term_program.h), for single precision.
//   TERM_QUADS=n  how many groups there are

layout(std140, binding = 0) uniform TermNumbers { vec4 termNumbers[TERM_QUADS]; };

vec4 quad(int n) {
    return termNumbers[n];
}

// What formulas read.
float formulaUniform(int k) {
    return termNumbers[k >> 2][k & 3];
}

// An affine matrix is three groups, its rows.
vec3 placed(int matrix, vec3 p) {
    vec4 h = vec4(p, 1.0);
    return vec3(dot(quad(matrix), h), dot(quad(matrix + 1), h), dot(quad(matrix + 2), h));
}

mat3 linearPart(int matrix) {
    return transpose(mat3(quad(matrix).xyz, quad(matrix + 1).xyz, quad(matrix + 2).xyz));
}

// A gradient behind the matrix as one before it.
vec3 turned(int matrix, vec3 gradient) {
    return gradient.x * quad(matrix).xyz + gradient.y * quad(matrix + 1).xyz + gradient.z * quad(matrix + 2).xyz;
}

// By the bits, as compilers may take it for granted that nothing is NaN.
bool isFinite(float x) {
    return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u;
}
bool isNan(float x) {
    return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u;
}
bool isPoint(vec3 p) {
    return isFinite(p.x) && isFinite(p.y) && isFinite(p.z);
}
float undefinedValue() {
    return uintBitsToFloat(0x7fc00000u);
}

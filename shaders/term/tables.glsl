// term/tables.glsl: piecewise-linear tables of a generated program, rows of one texture, linear between entries and held
// beyond their ends (render/term_tables.h).
//   table  a group of numbers: entry = value * x + y, the row's number in z, the change of entry per unit of value is x

uniform sampler1DArray tables;

vec4 tableEntry(int table, float value) {
    vec4 t = quad(table);
    float size = float(textureSize(tables, 0).x);
    float entry = clamp(value * t.x + t.y, 0.0, size - 1.0);
    return textureLod(tables, vec2((entry + 0.5) / size, t.z), 0.0);
}

// d result / d value.
float tableSlope(int table, float value) {
    vec4 t = quad(table);
    int last = textureSize(tables, 0).x - 1;
    float entry = value * t.x + t.y;
    int below = clamp(int(floor(entry)), 0, last - 1);
    float rise = texelFetch(tables, ivec2(below + 1, int(t.z)), 0).a - texelFetch(tables, ivec2(below, int(t.z)), 0).a;
    return entry < 0.0 || entry >= float(last) ? 0.0 : rise * t.x;
}

float mapped(int table, float value) {
    return isNan(value) ? value : tableEntry(table, value).a;
}

// term/fields.glsl: scalar fields of a generated program (core/fields). A field's value is NaN where it is undefined.
// Needs term/volumes.glsl.

// Letters: the distance in the plane from a table over x and z (beyond it the distance to it is added), joined with the
// extrusion along y (core/fields/text_field.h).
//   matrix  index coordinates of the table
//   shape   a group: the table's spacing along x, half the depth, the spacing along z, the world's y where p.y is 0
void textPlane(sampler3D table, int scale, int matrix, int shape, vec3 p, out vec3 inside, out vec2 beyond,
               out float plane) {
    vec3 index = placed(matrix, p);
    inside = vec3(1.0, 0.0, 1.0) * clamp(index, vec3(0.0), sizeOf(table) - 1.0);
    beyond = (index.xz - inside.xz) * quad(shape).xz;
    plane = linearRaw(table, inside) * quad(scale).x + quad(scale).y + length(beyond);
}

float textDistance(sampler3D table, int scale, int matrix, int shape, vec3 p) {
    vec3 inside;
    vec2 beyond;
    float plane;
    textPlane(table, scale, matrix, shape, p, inside, beyond, plane);
    float cap = abs(p.y + quad(shape).w) - quad(shape).y;
    return min(max(plane, cap), 0.0) + length(max(vec2(plane, cap), vec2(0.0)));
}

// The gradient and the value.
vec4 litTextDistance(sampler3D table, int scale, int matrix, int shape, vec3 p) {
    vec3 inside;
    vec2 beyond;
    float plane;
    textPlane(table, scale, matrix, shape, p, inside, beyond, plane);
    float y = p.y + quad(shape).w;
    float cap = abs(y) - quad(shape).y;
    vec2 g = turned(matrix, linearGradient(table, scale, inside)).xz;
    float outside = length(beyond);
    if (outside > 0.0) g = mix(g, vec2(0.0), notEqual(beyond, vec2(0.0))) + beyond / outside;
    vec3 ofPlane = vec3(g.x, 0.0, g.y);
    vec3 ofCap = vec3(0.0, y < 0.0 ? -1.0 : 1.0, 0.0);
    vec3 gradient = cap > plane ? ofCap : ofPlane;
    if (plane > 0.0 && cap > 0.0) gradient = (plane * ofPlane + cap * ofCap) / length(vec2(plane, cap));
    return vec4(gradient, min(max(plane, cap), 0.0) + length(max(vec2(plane, cap), vec2(0.0))));
}

// Derivative by differences of h; one-sided where the field ends (core/objects/attribute_field.h).
float slopeOf(float behind, float here, float ahead, float h) {
    float run = isNan(behind) || isNan(ahead) ? h : 2.0 * h;
    float slope = ((isNan(ahead) ? here : ahead) - (isNan(behind) ? here : behind)) / run;
    return isFinite(slope) ? slope : 0.0;
}

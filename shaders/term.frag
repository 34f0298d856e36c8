#version 450 core
// term.frag: one fragment of a slab of any term, by functions that are generated for it (render/term_program.h).
//   generated  Sample termAt(vec3 p), Sample litTermAt(vec3 p), bool withinTermAt(vec3 p), void startHints()
//   variants   MAPPED        places and Jacobian come from the polygon; else from one matrix
//              TERM_CELLS    the term has mapped cells
//              TERM_QUADS=n  groups of numbers
//              SHADED        Blinn-Phong by the gradient
//              SURROUNDINGS  with shadows and occlusion
//   out        color         premultiplied by alpha, to be composited under what is there
#include "common/slice_input.glsl"
#include "common/lighting.glsl"
#include "common/surroundings.glsl"
#include "common/slice_surroundings.glsl"
#include "common/cut_normal.glsl"
#include "common/formula.glsl"
#include "term/numbers.glsl"
#include "term/volumes.glsl"
#include "term/tables.glsl"
#include "term/fields.glsl"
#include "term/maps.glsl"
#ifdef TERM_CELLS
#include "common/cell_search.glsl"
#include "term/cells.glsl"
#endif
#include "term/sample.glsl"
#include "term/cvg.glsl"
#include "generated"
#include "term/term_slab.glsl"

layout(location = 0) out vec4 color;

void main() {
    vec3 ray, place, perDepth;
    mat3 jacobian;
    readSlice(ray, place, perDepth, jacobian);
#ifdef MAPPED
    if (!withinBounds(place)) discard;
#endif
    startHints();
    color = termSlab(place, perDepth, jacobian, ray);
    if (!(color.a > 0.0)) discard;
}

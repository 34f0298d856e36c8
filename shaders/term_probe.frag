#version 450 core
// term_probe.frag: what a term is at given points, for tests: one pixel, one point.
//   generated  as for term.frag
//   variants   TERM_CELLS, TERM_QUADS=n  as term.frag has them
//   out        seen     colour and opacity
//              litSeen  gradient and opacity of the function that gives both
uniform sampler2D points;  // less the program's origin

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

layout(location = 0) out vec4 seen;
layout(location = 1) out vec4 litSeen;

void main() {
    startHints();
    vec3 p = texelFetch(points, ivec2(gl_FragCoord.xy), 0).xyz;
    Sample s = termAt(p);
    seen = vec4(s.color, s.opacity);
    startHints();
    Sample lit = litTermAt(p);
    litSeen = vec4(lit.gradient, lit.opacity);
}

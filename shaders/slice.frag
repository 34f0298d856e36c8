#version 450 core
// slice.frag: one fragment of a slab, the piece of the view ray that one slice stands for.
//   variants  MAPPED            index coordinates and Jacobian come from the polygon; else from one matrix
//             SHADED            Blinn-Phong by the gradient
//             GRADIENT_OPACITY  a factor on opacity over the gradient's magnitude
//             REAL_VOXELS       the volume holds floats, which may be NaN: nothing is seen there
//             SEGMENTS=n        parts of the slab that are classified one by one
//             SUBSAMPLES=n      points of each that are classified
//   out       color             premultiplied by alpha, to be composited under what is there
#include "common/volume.glsl"
#include "common/classification.glsl"
#include "common/lighting.glsl"
#include "term/volume_slab.glsl"

in float sliceDepth;
#ifdef MAPPED
in vec3 cellIndex;
in vec3 jacobianX;
in vec3 jacobianY;
in vec3 jacobianZ;
#else
// Index coordinates at the reference depth, and d index / d depth along the ray, as functions of the window position:
// [0] + x [1] + y [2].
uniform mat3 indexAtReference;
uniform mat3 indexPerDepth;
uniform mat3 indexFromWorld;  // linear part
#endif
// World direction of unit depth through the window position, the same way.
uniform mat3 rayPerDepth;

layout(location = 0) out vec4 color;

void main() {
    vec3 window = vec3(1.0, gl_FragCoord.xy);
    vec3 ray = rayPerDepth * window;
#ifdef MAPPED
    mat3 jacobian = mat3(jacobianX, jacobianY, jacobianZ);
    vec3 index = cellIndex;
    vec3 perDepth = jacobian * ray;
    if (!insideVolume(index)) discard;
#else
    mat3 jacobian = indexFromWorld;
    vec3 perDepth = indexPerDepth * window;
    vec3 index = indexAtReference * window + sliceDepth * perDepth;
#endif
    color = volumeSlab(index, perDepth, ray, jacobian);
    if (color.a == 0.0) discard;
}

#version 450 core
// slice.frag: one fragment of a slab, the piece of the view ray that one slice stands for.
//   variants  MAPPED            index coordinates and Jacobian come from the polygon; else from one matrix
//             LOCATED           those are grid coordinates of a further map, in which each point is located
//             SHADED            Blinn-Phong by the gradient
//             SURROUNDINGS      with shadows and occlusion
//             GRADIENT_OPACITY  a factor on opacity over the gradient's magnitude
//             REAL_VOXELS       the volume holds floats, which may be NaN: nothing is seen there
//             SEGMENTS=n        parts of the slab that are classified one by one
//             SUBSAMPLES=n      points of each that are classified
//   out       color             premultiplied by alpha, to be composited under what is there
#include "common/volume.glsl"
#include "common/slice_input.glsl"
#include "common/classification.glsl"
#include "common/lighting.glsl"
#include "common/surroundings.glsl"
#include "common/slice_surroundings.glsl"
#include "common/cut_normal.glsl"
#include "common/volume_cut.glsl"
#ifdef LOCATED
#include "common/cell_search.glsl"
#include "common/located.glsl"
#include "common/located_ray.glsl"
#else
#include "common/slab_ray.glsl"
#endif
#include "term/volume_slab.glsl"

layout(location = 0) out vec4 color;

void main() {
    vec3 ray, index, perDepth;
    mat3 jacobian;
    readSlice(ray, index, perDepth, jacobian);
    SlabRay at = slabRay(index, perDepth, jacobian);
#ifdef MAPPED
    if (!indexOn(at, 0.0, index) || !insideVolume(index)) discard;
#endif
    color = volumeSlab(at, ray);
    if (color.a == 0.0) discard;
}

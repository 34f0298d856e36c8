// common/slice_input.glsl: where a fragment of a slice looks a volume up. Needs common/volume.glsl.

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

// ray       world direction of unit depth through the fragment
// index     index coordinates on the slice
// perDepth  their change per unit of depth along the ray
// jacobian  d index / d world
void readSlice(out vec3 ray, out vec3 index, out vec3 perDepth, out mat3 jacobian) {
    vec3 window = vec3(1.0, gl_FragCoord.xy);
    ray = rayPerDepth * window;
#ifdef MAPPED
    jacobian = mat3(jacobianX, jacobianY, jacobianZ);
    index = cellIndex;
    perDepth = jacobian * ray;
#else
    jacobian = indexFromWorld;
    perDepth = indexPerDepth * window;
    index = indexAtReference * window + sliceDepth * perDepth;
#endif
}

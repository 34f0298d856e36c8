// common/located_ray.glsl: the view ray through a fragment, bent by located maps; every point of it is located by itself.
// The same functions as common/slab_ray.glsl has. Needs common/volume.glsl, volume_cut.glsl, located.glsl.

uniform float slabDepth;  // extent of a slab along the view axis, world units

struct SlabRay {
    vec3 entry;     // grid coordinates of the first map on the slice
    vec3 perDepth;  // their change per unit of depth
    mat3 jacobian;  // d entry / d world
    uint hint[kMostLocated];
};

SlabRay slabRay(vec3 entry, vec3 perDepth, mat3 jacobian) {
    SlabRay at;
    at.entry = entry;
    at.perDepth = perDepth;
    at.jacobian = jacobian;
    at.hint = noHints();
    return at;
}

bool indexOn(inout SlabRay at, float depth, out vec3 index) {
    mat3 unused = mat3(1.0);
    Entered none;
    return locate(at.entry + depth * at.perDepth, at.hint, index, unused, vec3(0.0), none, false);
}

Entered placeOn(inout SlabRay at, float depth, vec3 ray, out vec3 index, out mat3 jacobian) {
    jacobian = at.jacobian;
    Entered last;
    locate(at.entry + depth * at.perDepth, at.hint, index, jacobian, ray, last, true);
    return last;
}

// Where the object ends between the slice and the neighbouring one at `outer`, where it is not.
float faceOn(inout SlabRay at, float outer) {
    float inner = 0.0;
    vec3 index;
    for (int n = 0; n < 12; ++n) {
        float middle = 0.5 * (inner + outer);
        if (indexOn(at, middle, index))
            inner = middle;
        else
            outer = middle;
    }
    return inner;
}

vec2 slabExtent(inout SlabRay at) {
    vec2 extent = vec2(-0.5, 0.5) * slabDepth;
    vec3 index;
    if (!indexOn(at, -slabDepth, index)) extent.x = faceOn(at, -slabDepth);
    if (!indexOn(at, slabDepth, index)) extent.y = faceOn(at, slabDepth);
    return extent;
}

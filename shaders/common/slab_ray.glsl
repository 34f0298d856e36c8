// common/slab_ray.glsl: the view ray through a fragment, straight in index coordinates. Needs common/volume.glsl.

uniform float slabDepth;  // extent of a slab along the view axis, world units

struct SlabRay {
    vec3 index;     // on the slice
    vec3 perDepth;  // its change per unit of depth
    mat3 jacobian;  // d index / d world
};

SlabRay slabRay(vec3 index, vec3 perDepth, mat3 jacobian) {
    return SlabRay(index, perDepth, jacobian);
}

// Index coordinates at a depth from the slice; false where there are none.
bool indexOn(inout SlabRay at, float depth, out vec3 index) {
    index = at.index + depth * at.perDepth;
    return true;
}

// The same, and d index / d world; gives the face that the ray, whose world direction of unit depth is `ray`, entered last
// before. Needs common/volume_cut.glsl.
Entered placeOn(inout SlabRay at, float depth, vec3 ray, out vec3 index, out mat3 jacobian) {
    jacobian = at.jacobian;
    indexOn(at, depth, index);
    return enteredBefore(index, jacobian, ray);
}

// The part of the ray, by depth from the slice, that its slab stands for: half a slab on either side, but at the volume's
// faces exactly up to the face. The neighbouring slice, which lies outside the volume there, draws nothing.
vec2 slabExtent(inout SlabRay at) {
    vec3 reach = abs(slabDepth * at.perDepth);
    vec2 middle = vec2(-0.5, 0.5) * slabDepth;
    if (all(greaterThan(at.index - reach, domainMin)) && all(lessThan(at.index + reach, domainMax))) return middle;
    vec2 face = domainCrossings(at.index, at.perDepth);
    return vec2(face.x > -slabDepth ? face.x : middle.x, face.y < slabDepth ? face.y : middle.y);
}

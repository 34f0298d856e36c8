#version 450 core
// fold.frag: one pre-image of a fragment of a slice where several may lie upon each other. Depth picks one of them:
// 1 - opacity, or with FIRST the same for all, so that the first drawn stays.
//   variants  MAPPED, LOCATED, SHADED, SURROUNDINGS, GRADIENT_OPACITY, REAL_VOXELS   as slice.frag has them
//             COVER   pre-images with nothing to be seen are drawn too, as they hide or cover others
//             FIRST   depth is left as it is
//             ADD     colour times opacity, and opacity, to be summed
//   out       sampled   colour and optical thickness of one opacity distance (ADD: see there)
//             lit       light as a factor on the colour, as white on top of it, and the thickness
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
#endif

layout(location = 0) out vec4 sampled;
layout(location = 1) out vec4 lit;

uniform float gradientUnit;          // data units per raw unit
uniform mat3 restFromIndexGradient;  // index gradient to the volume's own world

void main() {
    vec3 ray, index, perDepth;
    mat3 jacobian;
    readSlice(ray, index, perDepth, jacobian);
#ifdef LOCATED
    uint hint[kMostLocated] = noHints();
    Entered face;
    bool inside = locate(index, hint, index, jacobian, ray, face, true);
#else
    Entered face = enteredBefore(index, jacobian, ray);
    bool inside = insideVolume(index);
#endif
    float raw = rawAt(index);
    float entry = entryOf(raw);
    float thickness = inside ? thicknessAt(entry) : 0.0;
#ifdef REAL_VOXELS
    if (!isNumber(raw)) thickness = 0.0;
#endif
#ifndef COVER
    if (thickness == 0.0) discard;
#endif
    vec3 gradient = vec3(0.0);
#if defined(SHADED) || defined(GRADIENT_OPACITY)
    if (thickness > 0.0) gradient = rawDifferencesAt(index);
#endif
#ifdef GRADIENT_OPACITY
    float factor = gradientFactor(length(restFromIndexGradient * gradient) * gradientUnit);
    thickness = -log(1.0 - clamp(factor * (1.0 - exp(-thickness)), 0.0, 0.9999));
#endif
    vec2 light = vec2(1.0, 0.0);
#ifdef SHADED
    light = reflected(withCut(cutBy(face, ray), gradient * jacobian), ray, lightShare(0.0, 1.0 - exp(-thickness), ray));
#endif
    vec3 color = colorAt(entry);
    float clear = exp(-thickness);
#ifdef ADD
    sampled = vec4(color * (1.0 - clear), 1.0 - clear);
#else
    sampled = vec4(color, thickness);
#endif
    lit = vec4(light, thickness, 0.0);
#ifndef FIRST
    gl_FragDepth = clear;
#endif
}

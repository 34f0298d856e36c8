#version 450 core
// mask.frag: leaves only pixels that are nearly opaque; their depth then stops all later slices.

uniform sampler2D accumulated;
uniform float opaque;  // alpha from which on nothing behind can be told

void main() {
    if (texelFetch(accumulated, ivec2(gl_FragCoord.xy), 0).a < opaque) discard;
}

#version 450 core
// present.frag: a picture, of any resolution, with the background under it.
//   in  at       [0,1]² over the viewport
//   in  picture  premultiplied RGBA, linear filtering where enlarged
//   out colour   opaque sRGB
// Variants:
//   ENLARGED     the picture has fewer pixels than the viewport: smooth between them
//   TONED        exposure and tone mapping
#ifdef TONED
#include "common/tones.glsl"
#endif

in vec2 at;

uniform sampler2D picture;
uniform vec3 background;
uniform bool flipped;  // the picture's first row is its upper one
uniform bool opaque;   // the background is already under it
#ifdef ENLARGED
uniform float wide;    // the viewport's width / height over the picture's
#endif

layout(location = 0) out vec4 colour;

#ifdef ENLARGED
// Catmull and Rom's spline between pixels: 5 bilinear look-ups, the corners of the 16 pixels left out.
vec4 enlarged(vec2 at) {
    vec2 size = vec2(textureSize(picture, 0)), pixel = at * size, centre = floor(pixel - 0.5) + 0.5, f = pixel - centre;
    vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
    vec2 w3 = f * f * (-0.5 + 0.5 * f), w12 = 1.0 - w0 - w3;
    vec2 first = (centre - 1.0) / size, last = (centre + 2.0) / size, middle = (centre + (w12 - w1) / w12) / size;
    vec4 sum = texture(picture, middle) * (w12.x * w12.y);
    sum += texture(picture, vec2(middle.x, first.y)) * (w12.x * w0.y);
    sum += texture(picture, vec2(middle.x, last.y)) * (w12.x * w3.y);
    sum += texture(picture, vec2(first.x, middle.y)) * (w0.x * w12.y);
    sum += texture(picture, vec2(last.x, middle.y)) * (w3.x * w12.y);
    float weight = w12.x * w12.y + w12.x * (w0.y + w3.y) + w12.y * (w0.x + w3.x);
    return max(sum / weight, 0.0);
}
#endif

void main() {
    vec2 from = vec2(at.x, flipped ? 1.0 - at.y : at.y);
#ifdef ENLARGED
    vec4 c = enlarged(vec2(0.5 + (from.x - 0.5) * wide, from.y));
#else
    vec4 c = texture(picture, from);
#endif
#ifdef TONED
    vec3 object = max(opaque ? c.rgb - (1.0 - c.a) * background : c.rgb, 0.0);
    object = c.a > 0.0 ? c.a * toned(object / c.a) : object;
    colour = vec4(clamp(object + (1.0 - c.a) * background, 0.0, 1.0), 1.0);
#else
    colour = vec4(clamp(opaque ? c.rgb : c.rgb + (1.0 - c.a) * background, 0.0, 1.0), 1.0);
#endif
}

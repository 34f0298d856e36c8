#version 450 core
// present.frag: a picture, of any resolution, with the background under it.
//   in  at       [0,1]² over the viewport
//   in  picture  premultiplied RGBA
//   out colour   opaque sRGB
in vec2 at;

uniform sampler2D picture;
uniform vec3 background;
uniform bool flipped;  // the picture's first row is its upper one
uniform bool opaque;   // the background is already under it

layout(location = 0) out vec4 colour;

void main() {
    vec4 c = texture(picture, vec2(at.x, flipped ? 1.0 - at.y : at.y));
    colour = vec4(clamp(opaque ? c.rgb : c.rgb + (1.0 - c.a) * background, 0.0, 1.0), 1.0);
}

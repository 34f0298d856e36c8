#version 450 core
// imgui.frag: letters, shapes and pictures of the interface.
//   out colour  sRGB with straight alpha, to be blended over what is there
in vec2 fragmentTextureAt;
in vec4 fragmentColour;

uniform sampler2D image;

layout(location = 0) out vec4 colour;

void main() { colour = fragmentColour * texture(image, fragmentTextureAt); }

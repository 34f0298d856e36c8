#version 450 core
// imgui.vert: the interface's triangles.
//   in  position  pixels from the upper left; textureAt [0,1]²; colour sRGB with straight alpha
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 textureAt;
layout(location = 2) in vec4 colour;

uniform vec2 size;  // of the window, pixels

out vec2 fragmentTextureAt;
out vec4 fragmentColour;

void main() {
    fragmentTextureAt = textureAt;
    fragmentColour = colour;
    gl_Position = vec4(2.0 * position.x / size.x - 1.0, 1.0 - 2.0 * position.y / size.y, 0.0, 1.0);
}

#version 450 core
// overlay.vert: a rectangle about a thick line (or a point, whose ends are one).
//   corner   normalised device coordinates
//   ends     window coordinates of the line's two ends, pixels, y up
//   radii    of the fill and of the ring round it, pixels

layout(location = 0) in vec2 corner;
layout(location = 1) in vec4 ends;
layout(location = 2) in vec2 radii;
layout(location = 3) in vec4 fillColor;
layout(location = 4) in vec4 ringColor;
flat out vec4 lineEnds;
flat out vec2 lineRadii;
flat out vec4 lineFill;
flat out vec4 lineRing;

void main() {
    lineEnds = ends;
    lineRadii = radii;
    lineFill = fillColor;
    lineRing = ringColor;
    gl_Position = vec4(corner, 0.0, 1.0);
}

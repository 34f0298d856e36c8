#version 450 core
// screen.vert: one triangle over the whole viewport; needs no buffers.
//   out at  [0,1]² over the viewport, from the lower left
out vec2 at;

void main() {
    at = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(2.0 * at - 1.0, 0.0, 1.0);
}

#version 450 core
// slice.vert: corners of the polygons in which view-aligned planes cut cells.
//   in   position        x, y in normalised device coordinates; z the slice's depth along the view axis, world units,
//                        less the reference depth of the uniforms
//   with MAPPED also     vertexIndex, the source coordinate in index space, and d index / d world as three columns
// All corners of a polygon have one depth, so interpolation across the picture is linear and exact.

layout(location = 0) in vec3 position;
out float sliceDepth;
#ifdef MAPPED
layout(location = 1) in vec3 vertexIndex;
layout(location = 2) in vec3 vertexJacobianX;
layout(location = 3) in vec3 vertexJacobianY;
layout(location = 4) in vec3 vertexJacobianZ;
out vec3 cellIndex;
out vec3 jacobianX;
out vec3 jacobianY;
out vec3 jacobianZ;
#endif

void main() {
    sliceDepth = position.z;
#ifdef MAPPED
    cellIndex = vertexIndex;
    jacobianX = vertexJacobianX;
    jacobianY = vertexJacobianY;
    jacobianZ = vertexJacobianZ;
#endif
    gl_Position = vec4(position.xy, 0.0, 1.0);
}

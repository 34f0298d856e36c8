#pragma once
// Plane faces that cut a volume, as shaders/common/volume_cut.glsl takes them.

#include <vector>

#include "core/base/box3.h"
#include "render/gl_objects.h"

namespace voledit {

/// Plane faces at which data end.
struct CutFaces {
    Box3 box;  // index space: what the faces along its axes leave
    /// The others, with unit normals, positive within: planes[m] are of the coordinates in which map m's results are
    /// looked up, the last of them of index space.
    std::vector<std::vector<Vec4>> planes = {};
};

/// What the faces of `domain` leave of what `planes` do.
CutFaces cutFaces(const Box3& domain, std::vector<std::vector<Vec4>> planes);
void setCutFaces(Program& p, const CutFaces& faces);

}  // namespace voledit

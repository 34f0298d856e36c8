#include "render/cut_uniforms.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace voledit {

namespace {

constexpr int kMostPlanes = 64;      // as shaders/common/volume_cut.glsl has it …
constexpr std::size_t kSpaces = 9;   // … and how many spaces: SlicePlan::kMostLocated and one more
constexpr double kAlong = 1 - 1e-9;  // cosine of a normal along an axis

/// Shrinks `box` to what lies on the positive side of `face`; false if that is no box.
bool shrink(Box3& box, const Vec4& face) {
    for (int a = 0; a < 3; ++a) {
        if (std::abs(face[a]) < kAlong) continue;
        const double at = -face.w / face[a];
        if (face[a] > 0)
            box.min[a] = std::max(box.min[a], at);
        else
            box.max[a] = std::min(box.max[a], at);
        return true;
    }
    return false;
}

}  // namespace

CutFaces cutFaces(const Box3& domain, std::vector<std::vector<Vec4>> planes) {
    CutFaces faces{domain, std::move(planes)};
    if (!faces.planes.empty())
        std::erase_if(faces.planes.back(), [&](const Vec4& plane) { return shrink(faces.box, plane); });
    return faces;
}

void setCutFaces(Program& p, const CutFaces& faces) {
    int count = 0;
    for (std::size_t space = 0; space < kSpaces; ++space) {
        if (space < faces.planes.size())
            for (const Vec4& plane : faces.planes[space])
                if (count < kMostPlanes) p.set(("cutPlanes[" + std::to_string(count++) + "]").c_str(), Vec4f(plane));
        p.set(("cutPlaneEnds[" + std::to_string(space) + "]").c_str(), count);
    }
    p.set("cutMin", Vec3f(faces.box.min));
    p.set("cutMax", Vec3f(faces.box.max));
}

}  // namespace voledit

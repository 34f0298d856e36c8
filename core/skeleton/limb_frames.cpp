#include "core/skeleton/limb_frames.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace voledit {

Mat3 boneFrame(const Vec3& direction, double roll) {
    // Parallel to x to about the rounding of joints' positions; nearer than that the projection is noise.
    constexpr double kParallel = 1e-9;
    Vec3 x = Vec3(1, 0, 0) - direction * direction.x;
    if (glm::length(x) < kParallel) x = Vec3(0, 1, 0) - direction * direction.y;
    x = glm::normalize(x);
    const Vec3 y = glm::cross(direction, x);
    if (roll == 0) return {x, y, direction};
    const double c = std::cos(roll), s = std::sin(roll);
    return {c * x + s * y, c * y - s * x, direction};
}

Quad turned(const Quad& quad, int turns) {
    Quad result;
    for (std::size_t m = 0; m < 4; ++m) result[m] = quad[(m + std::size_t(turns)) % 4];
    return result;
}

PlacedLimb placedLimb(const Limb& limb, const Mat3& restFrame, int turns, const PosedJoint& from,
                      const PosedJoint& to) {
    PlacedLimb placed;
    placed.start = from.position;
    placed.end = to.position;
    placed.direction = glm::normalize(to.position - from.position);
    const Vec3 carried = from.linear * restFrame[2];
    const Quat arc = shortestArc(carried, placed.direction);
    const Vec3 x = arc * (from.linear * restFrame[0]), y = arc * (from.linear * restFrame[1]);
    placed.along = placed.direction * glm::length(carried);
    const Vec2 low = limb.offset - 0.5 * limb.size, high = limb.offset + 0.5 * limb.size;
    const Quad section{low.x * x + low.y * y, high.x * x + low.y * y, high.x * x + high.y * y, low.x * x + high.y * y};
    placed.section = turned(section, turns);
    // A quarter turn makes the frame's y the grid's u and the frame's −x its v.
    double u = -low.x / limb.size.x, v = -low.y / limb.size.y;
    for (int n = 0; n < turns; ++n) {
        const double frameX = u;
        u = v;
        v = 1 - frameX;
    }
    placed.bone[0] = u;
    placed.bone[1] = v;
    return placed;
}

}  // namespace voledit

#include "core/base/box3.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

namespace voledit {

Box3 join(const Box3& a, const Box3& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {glm::min(a.min, b.min), glm::max(a.max, b.max)};
}

Box3 join(const Box3& a, const Vec3& p) {
    return {glm::min(a.min, p), glm::max(a.max, p)};
}

Box3 intersect(const Box3& a, const Box3& b) {
    const Box3 common{glm::max(a.min, b.min), glm::min(a.max, b.max)};
    return common.empty() ? Box3{} : common;
}

Box3 transformed(const Box3& box, const Mat4& m) {
    Box3 result;
    if (box.empty()) return result;
    for (int c = 0; c < 8; ++c) result = join(result, transformPoint(m, box.corner(c)));
    return result;
}

Box3 movedBox(const Box3& box, const Mat4& m) {
    if (box.empty()) return {};
    const Vec3 half = 0.5 * (box.max - box.min);
    if (!std::isfinite(half.x + half.y + half.z)) return {Vec3(-kInfinity), Vec3(kInfinity)};
    const Vec3 centre = transformPoint(m, box.center());
    Vec3 reach(0);
    for (int c = 0; c < 3; ++c) reach += glm::abs(Vec3(m[c])) * half[c];
    return {centre - reach, centre + reach};
}

Frame frameOf(const Box3& box) {
    const Vec3 s = box.size();
    return {box.min, {Vec3{s.x, 0, 0}, Vec3{0, s.y, 0}, Vec3{0, 0, s.z}}};
}

Mat4 worldFromNormalised(const Frame& frame) {
    return Mat4(Vec4(frame.edge[0], 0), Vec4(frame.edge[1], 0), Vec4(frame.edge[2], 0), Vec4(frame.corner, 1));
}

Mat4 normalisedFromWorld(const Frame& frame) {
    return glm::inverse(worldFromNormalised(frame));
}

Box3 boundsOf(const Frame& frame) {
    return transformed({Vec3(0), Vec3(1)}, worldFromNormalised(frame));
}

}  // namespace voledit

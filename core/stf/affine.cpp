#include "core/stf/affine.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/error.h"

namespace voledit {

namespace {

Mat3 rotationAbout(int axis, double angle) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    Mat3 m(1.0);
    m[a][a] = m[b][b] = std::cos(angle);
    m[a][b] = std::sin(angle);
    m[b][a] = -m[a][b];
    return m;
}

void requireInvertible(const Mat4& m) {
    const std::string remedy = "give scales other than 0 and a matrix whose first three columns span space";
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r]))
                throw Error("affine transfer", "its matrix holds a number that is not finite", remedy);
    if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1)
        throw Error("affine transfer", "its matrix' last row is not 0 0 0 1", "give an affine matrix");
    const double lengths = glm::length(Vec3(m[0])) * glm::length(Vec3(m[1])) * glm::length(Vec3(m[2]));
    // Relative to the columns' lengths, so that a placement in nanometres is as good as one in kilometres.
    if (!(std::abs(glm::determinant(Mat3(m))) > 1e-12 * lengths))
        throw Error("affine transfer", "its matrix is singular: it flattens space", remedy);
}

}  // namespace

Mat4 placementMatrix(const Vec3& translate, const Vec3& rotate, const Vec3& scale) {
    const Mat3 linear = rotationAbout(2, rotate.z) * rotationAbout(1, rotate.y) * rotationAbout(0, rotate.x) *
                        Mat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
    Mat4 result(linear);
    result[3] = Vec4(translate, 1);
    return result;
}

AffineMap::AffineMap(const Mat4& worldFromRest) : worldFromRest_(worldFromRest) {
    requireInvertible(worldFromRest);
    restFromWorld_ = worldFromRest == Mat4(1.0) ? worldFromRest : glm::inverse(worldFromRest);
}

void AffineMap::map(std::span<const Vec3> p, std::span<Vec3> q) const {
    assert(p.size() == q.size());
    for (std::size_t i = 0; i < p.size(); ++i) q[i] = transformPoint(restFromWorld_, p[i]);
}

void AffineMap::jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const {
    assert(p.size() == jacobian.size());
    const Mat3 linear(restFromWorld_);
    for (std::size_t i = 0; i < p.size(); ++i) jacobian[i] = isDefined(p[i]) ? linear : Mat3(1.0);
}

Box3 AffineMap::imageOf(const Box3& rest) const {
    return transformed(rest, worldFromRest_);
}

bool AffineMap::anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const {
    // By centre and half sides: cheaper than eight corners.
    const Vec3 centre = transformPoint(restFromWorld_, box.center()), half = 0.5 * (box.max - box.min);
    Vec3 reach(0);
    for (int c = 0; c < 3; ++c) reach += glm::abs(Vec3(restFromWorld_[c])) * half[c];
    return found({centre - reach, centre + reach});
}

}  // namespace voledit

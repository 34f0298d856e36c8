#include "core/stf/affine.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/error.h"

namespace voledit {
namespace {

void expectNear(const Vec3& a, const Vec3& b, double tolerance = 1e-14) {
    EXPECT_LT(glm::length(a - b), tolerance) << a.x << " " << a.y << " " << a.z;
}

TEST(Affine, AnglesAreRightHandedAboutThePositiveAxis) {
    const double quarter = kPi / 2;
    expectNear(transformPoint(placementMatrix(Vec3(0), {quarter, 0, 0}, Vec3(1)), {0, 1, 0}), {0, 0, 1});
    expectNear(transformPoint(placementMatrix(Vec3(0), {0, quarter, 0}, Vec3(1)), {0, 0, 1}), {1, 0, 0});
    expectNear(transformPoint(placementMatrix(Vec3(0), {0, 0, quarter}, Vec3(1)), {1, 0, 0}), {0, 1, 0});
}

TEST(Affine, PlacementScalesThenTurnsAboutXYZThenMoves) {
    const Vec3 q(1, 2, 3), t(10, 20, 30), r(0.3, -0.7, 1.9), s(2, 0.5, -1);
    const auto turn = [](const Vec3& angles) { return placementMatrix(Vec3(0), angles, Vec3(1)); };
    const Vec3 scaled = q * s;
    const Vec3 x = transformPoint(turn({r.x, 0, 0}), scaled), y = transformPoint(turn({0, r.y, 0}), x),
               z = transformPoint(turn({0, 0, r.z}), y);
    expectNear(transformPoint(placementMatrix(t, r, s), q), z + t);
}

TEST(Affine, MapsBackWhatItsMatrixMovesAndKnowsItsJacobian) {
    const Mat4 m = placementMatrix({10, 20, 30}, {0.3, -0.7, 1.9}, {2, 0.5, -1});
    const AffineMap map(m);
    const Vec3 q(1, 2, 3);
    std::vector<Vec3> p{transformPoint(m, q), kUndefined};
    std::vector<Mat3> jacobian(2);
    map.jacobian(p, jacobian);
    map.map(p, p);
    expectNear(p[0], q, 1e-13);
    EXPECT_FALSE(isDefined(p[1]));
    const Mat3 product = jacobian[0] * Mat3(m);
    for (int c = 0; c < 3; ++c) expectNear(product[c], Mat3(1)[c]);
    EXPECT_EQ(jacobian[1], Mat3(1));
    const Box3 image = map.imageOf({Vec3(0), Vec3(1)});
    for (int c = 0; c < 8; ++c) EXPECT_TRUE(image.contains(transformPoint(m, Box3{Vec3(0), Vec3(1)}.corner(c))));
}

TEST(Affine, TheIdentityIsExact) {
    std::vector<Vec3> p{Vec3(0.1, 1e7, -3e-9)};
    AffineMap(Mat4(1.0)).map(p, p);
    EXPECT_EQ(p[0], Vec3(0.1, 1e7, -3e-9));
}

TEST(Affine, RefusesWhatFlattensSpace) {
    EXPECT_THROW(AffineMap(placementMatrix(Vec3(0), Vec3(0), {1, 0, 1})), Error);
    EXPECT_THROW(AffineMap(placementMatrix({kNaN, 0, 0}, Vec3(0), Vec3(1))), Error);
    Mat4 dependent(1.0);
    dependent[1] = dependent[0];
    EXPECT_THROW(AffineMap{dependent}, Error);
    Mat4 perspective(1.0);
    perspective[0][3] = 0.1;
    EXPECT_THROW(AffineMap{perspective}, Error);
    EXPECT_NO_THROW(AffineMap(placementMatrix(Vec3(0), Vec3(0), Vec3(1e-6)))) << "small is not flat";
}

}  // namespace
}  // namespace voledit

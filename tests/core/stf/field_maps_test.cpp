#include "core/stf/field_maps.h"

#include <gtest/gtest.h>

#include "core/fields/simple_fields.h"
#include "tests/core/stf/analytic_maps.h"

namespace voledit {
namespace {

const Box3 kUnit{Vec3(-1), Vec3(1)};

FieldPtr number(double value) {
    return std::make_shared<ConstantField>(value);
}

FieldPtr sineOf(int axis, double size) {
    return std::make_shared<FunctionField>([=](const Vec3& p) { return size * std::sin(p[axis]); },
                                           [=](const Vec3& p) {
                                               Vec3 gradient(0);
                                               gradient[axis] = size * std::cos(p[axis]);
                                               return gradient;
                                           },
                                           Interval{-size, size});
}

/// Channels Δ = (0.1·x, 0.2, 0) in index space of an 11³ grid over [0, 1]³.
std::shared_ptr<const Volume> deformation() {
    VolumeGrid grid{Index3(11), 3, Mat4(1)};
    for (int a = 0; a < 3; ++a) grid.worldFromIndex[a][a] = 0.1;
    std::vector<float> values;
    for (int n = 0; n < 11 * 11 * 11; ++n) values.insert(values.end(), {0.01f * float(n % 11), 0.2f, 0.0f});
    return Volume::fromValues(grid, values);
}

std::array<FieldPtr, 3> channelsOf(const std::shared_ptr<const Volume>& volume) {
    std::array<FieldPtr, 3> fields;
    for (std::size_t c = 0; c < 3; ++c) fields[c] = std::make_shared<VolumeField>(volume, int(c));
    return fields;
}

TEST(FieldsMap, TakesItsPointFromThreeFields) {
    const FieldsMap map({sineOf(1, 2), sineOf(2, 3), number(7)}, false, Outside::Hide);
    const Vec3 p(0.1, 0.2, 0.3);
    EXPECT_EQ(mappedBy(map, {p})[0], Vec3(2 * std::sin(0.2), 3 * std::sin(0.3), 7));
    const FieldsMap displacement({sineOf(1, 2), sineOf(2, 3), number(7)}, true, Outside::Keep);
    EXPECT_EQ(mappedBy(displacement, {p})[0], p + Vec3(2 * std::sin(0.2), 3 * std::sin(0.3), 7));
}

TEST(FieldsMap, IsHiddenOrKeptOutsideOfItsVolume) {
    const std::vector<Vec3> p{Vec3(0.5), Vec3(2)};
    const FieldsMap hide(channelsOf(deformation()), true, Outside::Hide),
        keep(channelsOf(deformation()), true, Outside::Keep);
    EXPECT_LT(glm::length(mappedBy(hide, p)[0] - Vec3(0.55, 0.7, 0.5)), 1e-7);
    EXPECT_FALSE(isDefined(mappedBy(hide, p)[1]));
    EXPECT_EQ(mappedBy(keep, p)[1], p[1]);
    std::vector<Mat3> jacobian(2);
    keep.jacobian(p, jacobian);
    EXPECT_NEAR(jacobian[0][0][0], 1.1, 1e-6);
    EXPECT_EQ(jacobian[1], Mat3(1));
    const std::vector<Vec3> nowhere{kUndefined};
    EXPECT_FALSE(isDefined(mappedBy(keep, nowhere)[0])) << "an undefined point is kept by nothing";
}

TEST(FieldsMap, JacobiansAreThoseOfFiniteDifferences) {
    const auto p = randomPoints(kUnit, 200);
    for (const bool displacement : {false, true})
        EXPECT_LT(
            jacobianError(FieldsMap({sineOf(1, 2), sineOf(0, 0.3), sineOf(2, 1)}, displacement, Outside::Hide), p),
            1e-9);
}

TEST(FieldsMap, SourceBoxesHoldAllImages) {
    for (const bool displacement : {false, true})
        for (const Outside outside : {Outside::Hide, Outside::Keep}) {
            const FieldsMap map(channelsOf(deformation()), displacement, outside);
            for (unsigned n = 0; n < 60; ++n) {
                const Vec3 corner = randomPoints({Vec3(-0.5), Vec3(1.3)}, 1, n)[0];
                EXPECT_EQ(straySources(map, {corner, corner + 0.02 * double(1 + n % 10)}, n), 0);
            }
        }
    const FieldsMap hide(channelsOf(deformation()), true, Outside::Hide);
    EXPECT_FALSE(hide.anySourceBox({Vec3(2), Vec3(3)}, [](const Box3&) { return true; }));
}

TEST(FieldsMap, ADisplacementGrowsTheBoxByItsLargestLength) {
    const Box3 rest{Vec3(0), Vec3(1)};
    const FieldsMap constant({number(0.3), number(0), number(-0.4)}, true, Outside::Keep);
    EXPECT_LT(glm::length(constant.imageOf(rest).min - Vec3(-0.5)), 1e-12);
    EXPECT_LT(glm::length(constant.imageOf(rest).max - Vec3(1.5)), 1e-12);

    const FieldsMap file(channelsOf(deformation()), true, Outside::Keep);
    const double largest = std::hypot(0.1, 0.2);
    const Box3 image = file.imageOf(rest);
    for (int a = 0; a < 3; ++a) {
        EXPECT_NEAR(image.min[a], -largest, 1e-6);
        EXPECT_NEAR(image.max[a], 1 + largest, 1e-6);
    }
    const auto around = randomPoints({Vec3(-2), Vec3(3)}, 100000);
    EXPECT_EQ(strayImages(file, {{0.2, 0.3, 0.4}, {0.9, 0.8, 0.7}}, around), 0);
    EXPECT_EQ(
        strayImages(FieldsMap({sineOf(1, 0.3), sineOf(2, 0.3), sineOf(0, 0.3)}, true, Outside::Keep), rest, around), 0);
    EXPECT_EQ(file.imageOf({Vec3(5), Vec3(6)}), (Box3{Vec3(5), Vec3(6)})) << "out of the field's reach";
}

TEST(FieldsMap, AMapLiesInItsFieldsDomainOrElseWhereTheOperandDid) {
    const Box3 rest{Vec3(-3), Vec3(-2)};
    const Box3 domain = FieldsMap(channelsOf(deformation()), false, Outside::Hide).imageOf(rest);
    EXPECT_LT(glm::length(domain.min) + glm::length(domain.max - 1.0), 1e-12);
    EXPECT_EQ(FieldsMap(channelsOf(deformation()), false, Outside::Keep).imageOf(rest), join(domain, rest));
    EXPECT_EQ(FieldsMap({sineOf(0, 1), sineOf(1, 1), sineOf(2, 1)}, false, Outside::Hide).imageOf(rest), rest);
}

}  // namespace
}  // namespace voledit

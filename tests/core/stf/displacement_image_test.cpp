#include "core/stf/displacement_image.h"

#include <gtest/gtest.h>

#include "core/fields/simple_fields.h"
#include "core/stf/composite_maps.h"
#include "tests/core/stf/analytic_maps.h"

namespace voledit {
namespace {

const Box3 kRest{{-1, -0.5, -0.8}, {0.9, 0.7, 1}};

/// Turned about z by `rate` radians for each unit of height, without end.
TransferPtr twist(double rate) {
    return std::make_shared<FunctionMap>(
        [rate](const Vec3& p) {
            const double c = std::cos(rate * p.z), s = std::sin(rate * p.z);
            return Vec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
        },
        2);
}
TransferPtr scaled(double by, TransferPtr of) {
    return std::make_shared<ScaledMap>(std::make_shared<ConstantField>(by), std::move(of));
}
TransferPtr sum(std::vector<TransferPtr> of) {
    return std::make_shared<SumMap>(std::move(of));
}

/// The largest |Δ| among points that `map` carries into `rest`: by chance, then about the best of them.
double largestDisplacement(const SpatialTransferFunction& map, const Box3& rest, double reach) {
    double largest = 0;
    Vec3 best(0);
    for (unsigned round = 0; round < 40; ++round) {
        const auto p = randomPoints({best - reach, best + reach}, round == 0 ? 300'000 : 3'000, round);
        const auto q = mappedBy(map, p);
        for (std::size_t n = 0; n < p.size(); ++n)
            if (isDefined(q[n]) && rest.contains(q[n]) && glm::length(q[n] - p[n]) > largest) {
                largest = glm::length(q[n] - p[n]);
                best = p[n];
            }
        reach *= round == 0 ? 0.1 : 0.8;
    }
    return largest;
}

TEST(ImageByDisplacement, GrowsByTheLargestDisplacementOfWhatIsCarriedIn) {
    const std::vector<std::pair<std::string, TransferPtr>> maps{
        {"waves", sum({wave(), wave()})},
        {"a twist, whose |Δ| has no bound in space", scaled(0.6, twist(0.7))},
        {"a twist overdone", scaled(1.5, twist(0.7))},
        {"a twist and waves", sum({twist(1.1), wave(), translation({0.4, 0, 0})})},
        {"half shrunk to half", scaled(0.5, std::make_shared<AffineMap>(placementMatrix(Vec3(0), Vec3(0), Vec3(2))))},
        {"with a border", sum({halfSpace({0.3, 0.1, 0}), wave()})}};
    for (const auto& [name, map] : maps) {
        const double largest = largestDisplacement(*map, kRest, 6);
        const Box3 image = imageByDisplacement(*map, kRest, kRest);
        const double reach = image.max.x - kRest.max.x;
        EXPECT_GE(reach, largest) << name;
        EXPECT_LT(reach, 1.15 * largest) << name << ", " << largest;
        EXPECT_NEAR(kRest.min.z - image.min.z, reach, 1e-12) << "on all sides";
    }
}

TEST(ImageByDisplacement, LeavesAloneWhatHasNoBounds) {
    EXPECT_TRUE(imageByDisplacement(*wave(), Box3{}, Box3{}).empty());
    const Box3 half{Vec3(0), Vec3(kInfinity)};
    EXPECT_EQ(imageByDisplacement(*wave(), half, half), half);
}

TEST(Blended, HoldsAllBlendsOfAllPoints) {
    const Box3 u{Vec3(-1), Vec3(2)}, v{Vec3(3), Vec3(4)};
    EXPECT_EQ(blended({0, 0}, u, v), u);
    EXPECT_EQ(blended({1, 1}, u, v), v);
    EXPECT_EQ(blended({0, 1}, u, v), join(u, v));
    EXPECT_EQ(blended({2, 2}, u, v), (Box3{Vec3(4), Vec3(9)}));
    const Box3 everywhere{Vec3(-kInfinity), Vec3(kInfinity)};
    EXPECT_EQ(blended({0, 0}, u, everywhere), u) << "what counts nothing may lie anywhere";
    EXPECT_EQ(blended(Interval{}, u, v), everywhere);
}

}  // namespace
}  // namespace voledit

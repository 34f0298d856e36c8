#include "core/objects/cvg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace voledit {
namespace {

constexpr CvgOperator kAll[]{CvgOperator::Union, CvgOperator::Intersection, CvgOperator::Difference, CvgOperator::Merge,
                             CvgOperator::Cap,   CvgOperator::Trim,         CvgOperator::Blend};

/// Samples of any opacity, often exactly 0, 1 or equal to another's.
std::vector<ObjectSample> randomSamples(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<ObjectSample> samples(count);
    for (ObjectSample& s : samples) {
        const double kind = unit(random), any = unit(random);
        s.opacity = kind < 0.15 ? 0 : kind < 0.3 ? 1 : kind < 0.5 ? 0.25 * std::floor(5 * any) : any;
        s.color = {unit(random), unit(random), unit(random)};
        s.value = unit(random) < 0.3 ? kNaN : unit(random);
        s.normalGradient = s.opacity > 0 && unit(random) < 0.8 ? s.color - 0.5 : Vec3(0);
    }
    return samples;
}

TEST(Cvg, OpacityAndColourAreThoseOfTheTable) {
    const auto a = randomSamples(4000, 1), b = randomSamples(4000, 2);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    for (std::size_t n = 0; n < a.size(); ++n) {
        const double o1 = a[n].opacity, o2 = b[n].opacity, w = n % 7 ? unit(random) : double(n % 2);
        const double blended[2]{(1 - w) * o1, w * o2};
        for (int c = 0; c < 3; ++c) {
            const double c1 = a[n].color[c], c2 = b[n].color[c];
            const double select = o1 >= o2 ? c1 : c2;
            const auto mix = [&](double weight1, double weight2) {
                return weight1 == 0 && weight2 == 0 ? (c1 + c2) / 2
                                                    : (weight1 * c1 + weight2 * c2) / (weight1 + weight2);
            };
            const double color[]{select, select, c1, mix(o1, o2), c1, c1, mix(blended[0], blended[1])};
            for (const CvgOperator by : kAll)
                EXPECT_NEAR(cvg(by, a[n], b[n], w).color[c], color[std::size_t(by)], 1e-15) << int(by);
        }
        const double opacity[]{std::max(o1, o2),    std::min(o1, o2),    std::max(0.0, o1 - o2), std::min(1.0, o1 + o2),
                               o1 <= o2 ? o1 : 0.0, o1 >= o2 ? o1 : 0.0, blended[0] + blended[1]};
        for (const CvgOperator by : kAll)
            EXPECT_EQ(cvg(by, a[n], b[n], w).opacity, opacity[std::size_t(by)]) << int(by);
    }
}

TEST(Cvg, OpacityOfUnionIntersectionAndMergeCommutes) {
    const auto a = randomSamples(1000, 4), b = randomSamples(1000, 5);
    for (std::size_t n = 0; n < a.size(); ++n) {
        for (const CvgOperator by : {CvgOperator::Union, CvgOperator::Intersection, CvgOperator::Merge})
            EXPECT_EQ(cvg(by, a[n], b[n]).opacity, cvg(by, b[n], a[n]).opacity);
        EXPECT_EQ(cvg(CvgOperator::Merge, a[n], b[n]).color, cvg(CvgOperator::Merge, b[n], a[n]).color);
        if (a[n].opacity != b[n].opacity) {
            EXPECT_EQ(cvg(CvgOperator::Union, a[n], b[n]).color, cvg(CvgOperator::Union, b[n], a[n]).color);
        }
        EXPECT_EQ(cvg(CvgOperator::Blend, a[n], b[n], 0.25).opacity, cvg(CvgOperator::Blend, b[n], a[n], 0.75).opacity);
    }
}

TEST(Cvg, OrderMattersWhereTheDefinitionsSaySo) {
    const ObjectSample red{0.5, {1, 0, 0}, 1, Vec3(1)}, blue{0.5, {0, 0, 1}, 2, Vec3(2)};
    EXPECT_EQ(cvg(CvgOperator::Union, red, blue).color, red.color) << "the first on a tie";
    EXPECT_EQ(cvg(CvgOperator::Union, blue, red).color, blue.color);
    // Merge: the sum of the first two is cut at 1 before the third comes.
    const ObjectSample green{0.8, {0, 1, 0}, 3, Vec3(3)};
    const auto merge = [](const ObjectSample& a, const ObjectSample& b) { return cvg(CvgOperator::Merge, a, b); };
    EXPECT_NE(merge(merge(red, green), blue).color, merge(red, merge(green, blue)).color);
    // Intersection: the smaller opacity goes on with the larger's colour.
    const ObjectSample faint{0.1, {0, 1, 0}, 3, Vec3(3)}, strong{0.9, {1, 1, 1}, 4, Vec3(4)};
    const auto common = [](const ObjectSample& a, const ObjectSample& b) {
        return cvg(CvgOperator::Intersection, a, b);
    };
    EXPECT_EQ(common(common(faint, strong), blue).color, blue.color);
    EXPECT_EQ(common(faint, common(strong, blue)).color, strong.color);
}

TEST(Cvg, IdentitiesOfASampleWithItselfAndWithNothing) {
    const ObjectSample nothing;
    for (const ObjectSample& s : randomSamples(300, 6)) {
        EXPECT_EQ(cvg(CvgOperator::Union, s, s).opacity, s.opacity);
        EXPECT_EQ(cvg(CvgOperator::Intersection, s, s).opacity, s.opacity);
        EXPECT_EQ(cvg(CvgOperator::Difference, s, s).opacity, 0);
        EXPECT_EQ(cvg(CvgOperator::Cap, s, s).opacity, s.opacity);
        EXPECT_EQ(cvg(CvgOperator::Trim, s, s).opacity, s.opacity);
        for (const CvgOperator by :
             {CvgOperator::Union, CvgOperator::Merge, CvgOperator::Difference, CvgOperator::Trim}) {
            const ObjectSample alone = cvg(by, s, nothing);
            EXPECT_EQ(alone.opacity, s.opacity);
            EXPECT_EQ(alone.normalGradient, s.normalGradient);
            if (s.opacity > 0) {
                EXPECT_NEAR(alone.color.g, s.color.g, 1e-15);
            }
        }
        EXPECT_EQ(cvg(CvgOperator::Cap, s, nothing).opacity, 0);
        EXPECT_EQ(cvg(CvgOperator::Blend, s, nothing, 0).opacity, s.opacity);
        EXPECT_EQ(cvg(CvgOperator::Blend, s, nothing, 1).opacity, 0);
    }
}

TEST(Cvg, TheOperandWhoseSurfaceIsSeenShades) {
    const ObjectSample strong{0.8, Vec3(1), 1, {1, 0, 0}}, weak{0.3, Vec3(0), 2, {0, 1, 0}};
    const auto gradient = [&](CvgOperator by, const ObjectSample& a, const ObjectSample& b, double w = 0) {
        return cvg(by, a, b, w).normalGradient;
    };
    for (const CvgOperator by : {CvgOperator::Union, CvgOperator::Merge}) {
        EXPECT_EQ(gradient(by, strong, weak), strong.normalGradient);
        EXPECT_EQ(gradient(by, weak, strong), strong.normalGradient);
    }
    EXPECT_EQ(gradient(CvgOperator::Intersection, strong, weak), weak.normalGradient);
    EXPECT_EQ(gradient(CvgOperator::Intersection, weak, strong), weak.normalGradient);
    EXPECT_EQ(gradient(CvgOperator::Difference, strong, weak), -weak.normalGradient) << "what is laid bare";
    EXPECT_EQ(gradient(CvgOperator::Difference, strong, ObjectSample{0.3, {}, 2, Vec3(0)}), strong.normalGradient);
    EXPECT_EQ(gradient(CvgOperator::Cap, weak, strong), weak.normalGradient);
    EXPECT_EQ(gradient(CvgOperator::Trim, strong, weak), strong.normalGradient);
    EXPECT_EQ(gradient(CvgOperator::Blend, strong, weak, 0.5), strong.normalGradient);
    EXPECT_EQ(gradient(CvgOperator::Blend, strong, weak, 0.8), weak.normalGradient);
    const ObjectSample tie{0.8, Vec3(0), 3, {0, 0, 1}};
    EXPECT_EQ(gradient(CvgOperator::Union, tie, strong), tie.normalGradient) << "as the colour: the first on a tie";
    EXPECT_EQ(gradient(CvgOperator::Intersection, tie, strong), tie.normalGradient);
}

TEST(Cvg, TheScalarIsThatOfTheLargerOpacity) {
    const ObjectSample a{0.8, {}, 1, {}}, b{0.3, {}, 2, {}}, plain{0.8, {}, kNaN, {}};
    for (const CvgOperator by : {CvgOperator::Union, CvgOperator::Intersection, CvgOperator::Merge}) {
        EXPECT_EQ(cvg(by, a, b).value, 1);
        EXPECT_EQ(cvg(by, b, a).value, 1);
        EXPECT_EQ(cvg(by, plain, a).value, 1) << "one that has a value before one that has none";
        EXPECT_TRUE(std::isnan(cvg(by, plain, b).value));
    }
    for (const CvgOperator by : {CvgOperator::Difference, CvgOperator::Cap, CvgOperator::Trim})
        EXPECT_EQ(cvg(by, b, a).value, 2);
    EXPECT_EQ(cvg(CvgOperator::Blend, a, b, 0.9).value, 2);
}

TEST(Cvg, NeitherNaNNorAWeightBeyondItsRangeLeavesTheRangeOfOpacity) {
    const auto a = randomSamples(300, 7), b = randomSamples(300, 8);
    for (std::size_t n = 0; n < a.size(); ++n) {
        EXPECT_EQ(cvg(CvgOperator::Blend, a[n], b[n], kNaN).opacity, 0);
        for (const double w : {-3.0, 1.5, 1e9, kInfinity, -kInfinity}) {
            const ObjectSample s = cvg(CvgOperator::Blend, a[n], b[n], w);
            EXPECT_TRUE(s.opacity >= 0 && s.opacity <= 1) << w;
            for (int c = 0; c < 3; ++c) EXPECT_TRUE(s.color[c] >= 0 && s.color[c] <= 1) << w;
        }
    }
}

}  // namespace
}  // namespace voledit

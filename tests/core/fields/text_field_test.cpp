#include "core/fields/text_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "core/base/error.h"
#include "core/fields/outline_distance.h"

namespace voledit {
namespace {

std::vector<Vec3> pointsAbout(const Box3& box, double margin, std::size_t count, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Vec3> p(count);
    for (Vec3& at : p)
        for (int a = 0; a < 3; ++a) at[a] = box.min[a] - margin + unit(random) * (box.max[a] - box.min[a] + 2 * margin);
    return p;
}

std::vector<double> valuesOf(const ScalarField& field, const std::vector<Vec3>& p) {
    std::vector<double> value(p.size());
    field.sample(p, value);
    return value;
}

double toSegments(const std::vector<OutlineSegment>& segments, const Vec2& p) {
    double nearest = kInfinity;
    for (const OutlineSegment& s : segments) {
        const Vec2 along = s.to - s.from;
        const double t = std::clamp(glm::dot(p - s.from, along) / glm::dot(along, along), 0.0, 1.0);
        nearest = std::min(nearest, glm::distance(p, s.from + t * along));
    }
    return nearest;
}

/// Whether outlines wind about p, by the sum of the angles they turn through.
bool windsAbout(const std::vector<GlyphOutline>& letters, const Vec2& p) {
    double angle = 0;
    for (const GlyphOutline& letter : letters)
        for (const OutlineSegment& s : letter.segments) {
            const Vec2 a = s.from - p, b = s.to - p;
            angle += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
        }
    return std::abs(angle) > kPi;
}

TEST(TextField, IsTheDistanceToTheOutlinesInItsPlane) {
    const std::string text = "Rag8%";
    const double height = 2;
    const TextField field(text, height, 1000);
    const auto letters = outlinesOf(text, height);
    std::vector<OutlineSegment> all;
    for (const GlyphOutline& letter : letters) all.insert(all.end(), letter.segments.begin(), letter.segments.end());
    Box3 box = field.bounds();
    box.min.y = box.max.y = 0;
    const auto p = pointsAbout(box, 0.2 * height, 2000);
    const auto value = valuesOf(field, p);
    const double spacing = field.outline()->grid().spacing().x;
    EXPECT_LE(spacing, height / 96);
    int inside = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec2 at(p[i].x, p[i].z);
        const double distance = toSegments(all, at);
        // Between samples the table is bilinear: never farther off than the samples about it are apart.
        EXPECT_NEAR(std::abs(value[i]), distance, spacing);
        if (distance < spacing) continue;
        EXPECT_EQ(value[i] < 0, windsAbout(letters, at));
        inside += value[i] < 0;
    }
    EXPECT_GT(inside, 200);
}

TEST(TextField, TheTableIsExactAtItsSamples) {
    const TextField field("Q&", 1, 1);
    const auto letters = outlinesOf("Q&", 1);
    const auto boundary = boundaryOf(letters);
    const Volume& table = *field.outline();
    std::mt19937 random(2);
    for (int n = 0; n < 500; ++n) {
        const Index3 at(int(random() % unsigned(table.grid().size.x)), 0,
                        int(random() % unsigned(table.grid().size.z)));
        const Vec3 p = transformPoint(table.grid().worldFromIndex, at);
        const double distance = toSegments(boundary, {p.x, p.z});
        EXPECT_NEAR(table.at(at), windsAbout(letters, {p.x, p.z}) ? -distance : distance, 1e-6);
    }
}

TEST(TextField, IsExtrudedAlongY) {
    const TextField field("H", 1, 0.4);
    const Vec3 center = field.bounds().center();
    EXPECT_DOUBLE_EQ(field.bounds().min.y, -0.2);
    EXPECT_DOUBLE_EQ(field.bounds().max.y, 0.2);
    EXPECT_NEAR(field.bounds().min.z, 0, 1e-9);
    EXPECT_NEAR(field.bounds().max.z, 1, 1e-9);
    const Vec3 stem(field.bounds().min.x + 0.08, 0, 0.2);
    const double inPlane = valuesOf(TextField("H", 1, 1000), {stem})[0];
    ASSERT_LT(inPlane, -0.05);
    EXPECT_NEAR(valuesOf(field, {stem})[0], std::max(inPlane, -0.2), 1e-6);
    EXPECT_NEAR(valuesOf(field, {Vec3(stem.x, 0.19, stem.z)})[0], -0.01, 1e-6);
    EXPECT_NEAR(valuesOf(field, {Vec3(stem.x, -0.5, stem.z)})[0], 0.3, 1e-6);
    // Beside the stem and above the face: to the edge between them.
    const Vec3 beside(field.bounds().min.x - 0.12, 0.2 + 0.16, 0.5);
    EXPECT_NEAR(valuesOf(field, {beside})[0], 0.2, 0.005);
    EXPECT_GT(valuesOf(field, {center + Vec3(0, 0, 0.3)})[0], 0) << "between the stems";
}

TEST(TextField, BeyondItsTableDistanceGoesOn) {
    const TextField field("I", 1, 0.2);
    const Box3 box = field.bounds();
    const Vec3 left(box.min.x - 3, 0, 0.5), above(box.center().x, 0, 6);
    EXPECT_NEAR(valuesOf(field, {left})[0], 3, 1e-3);
    EXPECT_NEAR(valuesOf(field, {above})[0], 5, 1e-3);
    EXPECT_TRUE(std::isnan(valuesOf(field, {kUndefined})[0]));
    EXPECT_TRUE(std::isnan(valuesOf(field, {Vec3(0, kNaN, 0)})[0]));
}

TEST(TextField, GradientIsThatOfItsValues) {
    const TextField field("S2", 1, 0.3);
    const auto p = pointsAbout(field.bounds(), 0.6, 1500, 3);
    std::vector<Vec3> gradient(p.size());
    field.gradient(p, gradient);
    int compared = 0;
    const double h = field.outline()->grid().spacing().x;
    const Box3 table = boundsOf(field.outline()->grid().worldFrame());
    for (std::size_t i = 0; i < p.size(); ++i) {
        Vec3 expected;
        bool smooth = true;
        for (int a = 0; a < 3; ++a) {
            Vec3 step(0);
            step[a] = h;
            const auto v = valuesOf(field, {p[i] - step, p[i], p[i] + step});
            expected[a] = (v[2] - v[0]) / (2 * h);
            smooth = smooth && std::abs(v[2] - 2 * v[1] + v[0]) < 0.02 * h;
        }
        if (!smooth) continue;  // on a kink, as the middle of a stroke
        ++compared;
        EXPECT_LT(glm::distance(gradient[i], expected), 0.05);
        if (table.contains({p[i].x, 0, p[i].z})) {
            EXPECT_NEAR(glm::length(gradient[i]), 1, 0.05);
        }
    }
    EXPECT_GT(compared, 700);
    std::vector<Vec3> nowhere(1);
    field.gradient(std::vector{kUndefined}, nowhere);
    EXPECT_EQ(nowhere[0], Vec3(0));
}

TEST(TextField, RangeHoldsItsValues) {
    const TextField field("W7", 1, 0.3);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(0, 1);
    int outside = 0;
    for (const Vec3& corner : pointsAbout(field.bounds(), 0.8, 400, 5)) {
        const Vec3 size = 0.3 * Vec3(unit(random), unit(random), unit(random));
        const Interval range = field.range({corner, corner + size});
        std::vector<Vec3> p;
        for (int n = 0; n < 30; ++n) p.push_back(corner + size * Vec3(unit(random), unit(random), unit(random)));
        for (const double v : valuesOf(field, p)) EXPECT_TRUE(range.low - 1e-9 <= v && v <= range.high + 1e-9);
        outside += range.low > 0;
    }
    EXPECT_GT(outside, 100);
}

TEST(TextField, LongTextsKeepToATableThatGraphicsCanHold) {
    const TextField field(std::string(200, 'W'), 3, 1);
    EXPECT_LE(field.outline()->grid().size.x, 2048);
    EXPECT_GT(field.bounds().max.x, 600);
}

TEST(TextField, SizesThatAreNoneAreErrors) {
    for (const double bad : {0.0, -1.0, kNaN, kInfinity}) {
        EXPECT_THROW(TextField("a", bad, 1), Error);
        EXPECT_THROW(TextField("a", 1, bad), Error);
    }
}

}  // namespace
}  // namespace voledit

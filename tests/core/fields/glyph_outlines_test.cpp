#include "core/fields/glyph_outlines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/error.h"

namespace voledit {
namespace {

std::string messageOf(const std::string& text) {
    try {
        outlinesOf(text, 1);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

/// Area by contours that wind counter-clockwise or clockwise throughout.
double areaOf(const GlyphOutline& outline) {
    double twice = 0;
    for (const OutlineSegment& s : outline.segments) twice += s.from.x * s.to.y - s.to.x * s.from.y;
    return std::abs(0.5 * twice);
}

TEST(GlyphOutlines, CapitalsStandOnTheLineAndAreAsTallAsAsked) {
    for (const double height : {1.0, 25.0}) {
        const auto letters = outlinesOf("HIE", height);
        ASSERT_EQ(letters.size(), 3u);
        for (const GlyphOutline& letter : letters) {
            EXPECT_NEAR(letter.min.y, 0, 1e-9 * height);
            EXPECT_NEAR(letter.max.y, height, 1e-9 * height);
        }
        EXPECT_LT(letters[0].max.x, letters[1].min.x);
        EXPECT_LT(letters[1].max.x, letters[2].min.x);
        EXPECT_GE(letters[0].min.x, 0);
    }
}

TEST(GlyphOutlines, ContoursAreClosedAndHaveHoles) {
    for (const GlyphOutline& letter : outlinesOf("Bag8&ß", 1)) {
        std::size_t starts = 0;
        Vec2 start = letter.segments.front().from;
        for (std::size_t n = 0; n < letter.segments.size(); ++n) {
            const bool last = n + 1 == letter.segments.size();
            if (!last && letter.segments[n + 1].from == letter.segments[n].to) continue;
            EXPECT_EQ(letter.segments[n].to, start);
            ++starts;
            if (!last) start = letter.segments[n + 1].from;
        }
        EXPECT_GE(starts, 1u);
    }
    const auto solid = outlinesOf("I", 1)[0], ring = outlinesOf("O", 1)[0];
    EXPECT_NEAR(areaOf(solid), solid.max.x - solid.min.x, 1e-9) << "a bar";
    const Vec2 box = ring.max - ring.min;
    EXPECT_LT(areaOf(ring), 0.7 * 0.785 * box.x * box.y) << "a ring covers less than an ellipse";
}

TEST(GlyphOutlines, CurvesAreFlattenedFinely) {
    // No corner of an O turns by more than what a deviation of 10⁻⁴ at its tightest bend allows.
    const auto ring = outlinesOf("O", 1)[0];
    EXPECT_GT(ring.segments.size(), 100u);
    for (std::size_t n = 0; n + 1 < ring.segments.size(); ++n) {
        if (ring.segments[n].to != ring.segments[n + 1].from) continue;
        const Vec2 a = glm::normalize(ring.segments[n].to - ring.segments[n].from),
                   b = glm::normalize(ring.segments[n + 1].to - ring.segments[n + 1].from);
        EXPECT_GT(glm::dot(a, b), std::cos(0.15));
    }
}

TEST(GlyphOutlines, PairsAreKerned) {
    const auto gap = [](const std::string& pair) {
        const auto letters = outlinesOf(pair, 1);
        return letters[1].min.x - letters[0].max.x;
    };
    EXPECT_LT(gap("AV"), gap("HH") - 0.15);
    EXPECT_LT(gap("To"), gap("Ho") - 0.1);
}

TEST(GlyphOutlines, SpacesAdvanceWithoutOutlines) {
    const auto with = outlinesOf("H H", 1), without = outlinesOf("HH", 1);
    ASSERT_EQ(with.size(), 2u);
    EXPECT_GT(with[1].min.x, without[1].min.x + 0.2);
}

TEST(GlyphOutlines, TextThatCannotBeLetteredIsAnError) {
    EXPECT_NE(messageOf("").find("empty"), std::string::npos);
    EXPECT_NE(messageOf("   ").find("shows nothing"), std::string::npos);
    EXPECT_NE(messageOf("a\nb").find("control character"), std::string::npos);
    EXPECT_NE(messageOf("\xff").find("UTF-8"), std::string::npos);
    EXPECT_NE(messageOf("\xc3").find("UTF-8"), std::string::npos);
    EXPECT_NE(messageOf("\xc0\x80").find("UTF-8"), std::string::npos) << "too long a spelling";
    EXPECT_NE(messageOf("\xf8\x88\x80\x80\x80").find("UTF-8"), std::string::npos);
    EXPECT_NE(messageOf("\xe4\xbd\xa0").find("U+4F60"), std::string::npos);
    EXPECT_NE(messageOf(std::string(201, 'a')).find("201 characters"), std::string::npos);
    EXPECT_EQ(messageOf(std::string(200, 'a')), "");
    EXPECT_EQ(messageOf("ß€Ω"), "");
}

}  // namespace
}  // namespace voledit

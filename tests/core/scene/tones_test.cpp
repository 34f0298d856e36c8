#include "core/scene/tones.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voledit {
namespace {

// IEC 61966-2-1, both ways.
double linearOf(double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
double srgbOf(double l) {
    return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
}

RenderSettings with(ToneMapping mapping, double exposure) {
    RenderSettings settings;
    settings.toneMapping = mapping;
    settings.exposure = exposure;
    return settings;
}

TEST(Tones, WithoutAnyAPictureStaysAsItIs) {
    Picture picture({2, 1});
    picture.at(0, 0) = Vec4f(0.123f, 3.5f, -0.2f, 0.25f);
    EXPECT_TRUE(Tones({}).none());
    EXPECT_EQ(finishedPicture(picture, {}).pixels, picture.pixels);
}

TEST(Tones, AStopIsTwiceTheLight) {
    for (const double stops : {-2.0, -0.5, 1.0, 3.0}) {
        const Tones tones(with(ToneMapping::None, stops));
        for (const double c : {0.0, 0.01, 0.2, 0.5, 0.9})
            EXPECT_NEAR(tones(float(c)), srgbOf(std::exp2(stops) * linearOf(c)), 5e-4) << stops << " " << c;
    }
}

TEST(Tones, FilmicKeepsMiddleGreyAndTellsHighlightsApart) {
    const Tones tones(with(ToneMapping::Filmic, 0));
    const double grey = srgbOf(0.18);
    EXPECT_NEAR(tones(float(grey)), grey, 1e-3);
    EXPECT_NEAR(linearOf(tones(1)), 0.726, 2e-3);  // the curve at 1 · 0.72317
    float before = -1;
    for (float c = 0; c < 2.4f; c += 0.1f) {  // to eight times white
        EXPECT_GT(tones(c), before);
        before = tones(c);
    }
    EXPECT_LE(before, 1);
}

TEST(Tones, TheBackgroundStaysAsItWasPicked) {
    RenderSettings settings = with(ToneMapping::Filmic, 2);
    settings.background = Vec3(0.2, 0.4, 0.6);
    Picture picture({2, 1}, Vec4f(0.2f, 0.4f, 0.6f, 0));
    const float grey = 0.5f, alpha = 0.25f;
    picture.at(1, 0) = Vec4f(alpha * grey + (1 - alpha) * Vec3f(settings.background), alpha);
    const Picture seen = finishedPicture(picture, settings);
    EXPECT_EQ(seen.at(0, 0), picture.at(0, 0));
    const float toned = Tones(settings)(grey);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen.at(1, 0)[c], alpha * toned + (1 - alpha) * settings.background[c], 1e-5);
}

TEST(Tones, ATransparentPictureHasNoBackground) {
    RenderSettings settings;
    settings.background = Vec3(0.2, 0.4, 0.6);
    settings.transparent = true;
    Picture picture({1, 1});
    picture.at(0, 0) = Vec4f(Vec3f(0.1f, 0.05f, 0) + 0.75f * Vec3f(settings.background), 0.25f);
    const Vec4f seen = finishedPicture(picture, settings).at(0, 0);
    EXPECT_NEAR(seen.r, 0.1, 1e-6);
    EXPECT_NEAR(seen.g, 0.05, 1e-6);
    EXPECT_NEAR(seen.b, 0, 1e-6);
    EXPECT_EQ(seen.a, 0.25f);
}

TEST(Tones, ReducedPixelsAreMeans) {
    Picture picture({4, 2});
    for (int n = 0; n < 8; ++n) picture.pixels[std::size_t(n)] = Vec4f(float(n), 0, 1, float(n) / 8);
    const Picture half = reduced(picture, 2);
    EXPECT_EQ(half.size, Index2(2, 1));
    EXPECT_EQ(half.at(0, 0), Vec4f(2.5f, 0, 1, 2.5f / 8));
    EXPECT_EQ(half.at(1, 0), Vec4f(4.5f, 0, 1, 4.5f / 8));
    EXPECT_EQ(reduced(picture, 1).pixels, picture.pixels);
}

}  // namespace
}  // namespace voledit

#include "render/overlay.h"

#include <glad/gl.h>

#include "render/gl_objects.h"
#include "tests/render/render_fixtures.h"

namespace voledit {
namespace {

using namespace test;

constexpr Index2 kSize{100, 80};

/// Draws over an opaque blue picture; rows from the top.
Picture drawn(const Overlay& overlay, const Camera& camera) {
    offscreen();
    const Texture color = makeTexture2D(GL_RGBA32F, kSize);
    const Framebuffer framebuffer = makeFramebuffer(color.name(), 0, false);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glViewport(0, 0, kSize.x, kSize.y);
    const float blue[4] = {0, 0, 1, 1};
    glClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, blue);
    OverlayRenderer renderer;
    renderer.draw(overlay, camera, kSize);
    Picture rows(kSize), picture(kSize);
    glGetTextureImage(color.name(), 0, GL_RGBA, GL_FLOAT, GLsizei(rows.pixels.size() * sizeof(Vec4f)),
                      rows.pixels.data());
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) picture.at(x, y) = rows.at(x, kSize.y - 1 - y);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return picture;
}

const Camera kCamera{{0, -4, 0}, {0, 0, 0}, {0, 0, 1}, 30};
const Vec4f kRed{1, 0, 0, 1}, kBlue{0, 0, 1, 1}, kGreen{0, 1, 0, 1};

TEST(Overlay, PointsLieWhereTheCameraProjectsThem) {
    const Vec3 at{0.3, 0.2, 0.25};
    const Picture picture = drawn({{}, {{at, kRed, 5, kGreen}}}, kCamera);
    const Vec3 pixel = project(kCamera, kSize, at);
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
            const double d = std::hypot(x + 0.5 - pixel.x, y + 0.5 - pixel.y);
            if (d < 4.5) {
                ASSERT_EQ(picture.at(x, y), kRed) << x << "," << y;
            }
            if (d > 5.5 && d < 6) {
                ASSERT_EQ(picture.at(x, y), kGreen) << x << "," << y;
            }
            if (d > 7.5) {
                ASSERT_EQ(picture.at(x, y), kBlue) << x << "," << y;
            }
        }
}

TEST(Overlay, LinesHaveTheirWidthAndSmoothEdges) {
    const Picture picture = drawn({{{{-2, 0, 0}, {2, 0, 0}, kRed, 4}}, {}}, kCamera);
    double covered = 0;
    for (int y = 0; y < kSize.y; ++y) covered += picture.at(50, y).r;
    EXPECT_NEAR(covered, 4, 0.05);
    EXPECT_EQ(picture.at(0, 40), kRed);
    EXPECT_EQ(picture.at(99, 39), kRed);
    EXPECT_EQ(picture.at(50, 36), kBlue);
    // Half transparent, half as red.
    const Picture faint = drawn({{{{-2, 0, 0}, {2, 0, 0}, {1, 0, 0, 0.5F}, 4}}, {}}, kCamera);
    EXPECT_NEAR(faint.at(50, 40).r, 0.5, 0.01);
    EXPECT_NEAR(faint.at(50, 40).b, 0.5, 0.01);
}

TEST(Overlay, WhatLiesBehindTheEyeIsCutOff) {
    const Picture behind = drawn({{{{-1, -8, 0}, {1, -8, 0}, kRed, 4}}, {{{0, -8, 0}, kRed, 5, kGreen}}}, kCamera);
    for (const Vec4f& p : behind.pixels) ASSERT_EQ(p, kBlue);
    // From behind the eye to the picture's middle: only its visible part.
    const Picture through = drawn({{{{0.5, -8, 0}, {0, 0, 0}, kRed, 3}}, {}}, kCamera);
    EXPECT_EQ(through.at(50, 40), kRed);
    EXPECT_EQ(through.at(40, 40), kBlue);
}

TEST(Overlay, LeavesGlAsItWas) {
    offscreen();
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    drawn({{}, {{{0, 0, 0}, kRed, 5, kGreen}}}, kCamera);
    EXPECT_TRUE(glIsEnabled(GL_DEPTH_TEST));
    EXPECT_FALSE(glIsEnabled(GL_BLEND));
    glDisable(GL_DEPTH_TEST);
}

}  // namespace
}  // namespace voledit

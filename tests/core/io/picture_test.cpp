#include <gmock/gmock.h>

#include "tests/core/io/picture_files.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;

Picture ramp() {
    Picture picture(Index2(16, 4));
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 16; ++x) picture.at(x, y) = Vec4f(float(x) / 15, float(y) / 3, 0.5f, 1);
    return picture;
}

TEST(Pictures, PngRoundTripsToEightBits) {
    const fs::path folder = test::scratchFolder();
    const Picture picture = ramp();
    IoClient io;
    io.writePicture(picture, folder / "a.png");
    const Picture back = io.readPicture(folder / "a.png");
    EXPECT_EQ(back.size, picture.size);
    EXPECT_EQ(toRgb8(back), toRgb8(picture));
    EXPECT_EQ(back.at(3, 2).w, 1);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

TEST(Pictures, ExrHoldsLinearLight) {
    const fs::path path = test::scratchFolder() / "a.exr";
    Picture picture(Index2(3, 1));
    picture.at(0, 0) = Vec4f(0, 0.04f, 0.5f, 1);
    picture.at(1, 0) = Vec4f(1, 0.25f, 0.75f, 0.5f);
    picture.at(2, 0) = Vec4f(2, -0.5f, 0, 0);
    IoClient io;
    io.writePicture(picture, path);
    const Picture back = io.readPicture(path);
    // IEC 61966-2-1: 0.5 is 0.21404 of the light.
    EXPECT_NEAR(back.at(0, 0).x, 0, 1e-7);
    EXPECT_NEAR(back.at(0, 0).y, 0.04f / 12.92f, 1e-7);
    EXPECT_NEAR(back.at(0, 0).z, 0.2140411, 1e-6);
    EXPECT_NEAR(back.at(1, 0).x, 1, 1e-6);
    EXPECT_NEAR(back.at(1, 0).w, 0.5, 1e-7);
    EXPECT_NEAR(back.at(2, 0).x, 4.9538, 1e-3);
    EXPECT_NEAR(back.at(2, 0).y, -0.2140411, 1e-6);
}

// Colours multiplied by alpha: half covered by 0.8, 0.4, 0; nothing; all of 1, 0.5, 0.25.
Picture cutOut() {
    Picture picture(Index2(3, 1));
    picture.at(0, 0) = Vec4f(0.4f, 0.2f, 0, 0.5f);
    picture.at(2, 0) = Vec4f(1, 0.5f, 0.25f, 1);
    return picture;
}

TEST(Pictures, ATransparentPngHasStraightAlpha) {
    const fs::path path = test::scratchFolder() / "a.png";
    IoClient io;
    io.writePicture(cutOut(), path, true);
    const Picture back = io.readPicture(path);
    const auto bytesAt = [&](int x) {
        const Vec4f scaled = 255.0f * back.at(x, 0);
        return std::vector<long>{std::lround(scaled.r), std::lround(scaled.g), std::lround(scaled.b),
                                 std::lround(scaled.a)};
    };
    EXPECT_EQ(bytesAt(0), (std::vector<long>{204, 102, 0, 128}));
    EXPECT_EQ(bytesAt(1), (std::vector<long>{0, 0, 0, 0}));
    EXPECT_EQ(bytesAt(2), (std::vector<long>{255, 128, 64, 255}));
}

TEST(Pictures, ATransparentExrHasLightMultipliedByAlpha) {
    const fs::path path = test::scratchFolder() / "a.exr";
    IoClient io;
    io.writePicture(cutOut(), path, true);
    const Picture back = io.readPicture(path);
    // IEC 61966-2-1: 0.8 is 0.60383 of the light, half of which reaches the eye; 0.5 is 0.21404.
    EXPECT_NEAR(back.at(0, 0).r, 0.5 * 0.603827, 1e-5);
    EXPECT_NEAR(back.at(0, 0).a, 0.5, 1e-7);
    EXPECT_EQ(back.at(1, 0), Vec4f(0));
    EXPECT_NEAR(back.at(2, 0).g, 0.2140411, 1e-6);
}

TEST(Pictures, GreyIsSpread) {
    const fs::path folder = test::scratchFolder();
    IoClient io;
    const Picture grey =
        io.readPicture(test::writeFile(folder / "g.png", test::pngBytes(2, std::vector<std::uint8_t>{0, 255})));
    EXPECT_EQ(grey.at(0, 0), Vec4f(0, 0, 0, 1));
    EXPECT_EQ(grey.at(1, 0), Vec4f(1));
}

TEST(Pictures, RefusesWhatItCannotDo) {
    const fs::path folder = test::scratchFolder();
    IoClient io;
    EXPECT_THROW(io.writePicture(ramp(), folder / "a.gif"), Error);
    EXPECT_THROW(io.writePicture(Picture(), folder / "a.png"), Error);
    EXPECT_THROW(io.writePicture(ramp(), folder / "none" / "a.png"), Error);
    EXPECT_THROW(io.readPicture(folder / "missing.png"), Error);
    EXPECT_THROW(io.readPicture(test::writeFile(folder / "empty.jpg", "")), Error);
    EXPECT_THROW(io.readPicture(test::writeFile(folder / "garbage.png", std::string(1000, 'x'))), Error);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 2);
}

}  // namespace
}  // namespace voledit

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

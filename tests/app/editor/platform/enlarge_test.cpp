#include "app/editor/platform/enlarge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/parallel.h"
#include "core/scene/camera.h"

namespace voledit {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes enlarged(const Picture& picture, Index2 size) {
    Bytes bytes;
    enlarge(picture, size, bytes);
    return bytes;
}

// Red and green say where a pixel of a picture of `camera` looks.
Picture directions(const Camera& camera, Index2 size) {
    Picture picture(size);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const Vec3 ray = rayThrough(camera, size, x + 0.5, y + 0.5);
            picture.at(x, y) = Vec4f(0.5 + ray.x / ray.y, 0.5 + ray.z / ray.y, 0, 1);
        }
    return picture;
}

TEST(Enlarge, OfItsOwnSizeIsThePictureFromBelow) {
    Picture picture({3, 2});
    picture.at(0, 0) = Vec4f(1, 0.5, 0, 0.3);
    picture.at(2, 1) = Vec4f(-1, 2, 0.25, 1);
    const Bytes bytes = enlarged(picture, {3, 2});
    EXPECT_EQ(Bytes(&bytes[12], &bytes[16]), (Bytes{255, 128, 0, 255}));
    EXPECT_EQ(Bytes(&bytes[8], &bytes[12]), (Bytes{0, 255, 64, 255}));
}

TEST(Enlarge, AConstantStaysOne) {
    const Bytes bytes = enlarged(Picture({7, 5}, Vec4f(0.2f, 0.4f, 0.6f, 1)), {40, 31});
    for (std::size_t n = 0; n < bytes.size(); n += 4)
        ASSERT_EQ(Bytes(&bytes[n], &bytes[n + 4]), (Bytes{51, 102, 153, 255}));
}

// Whatever the small picture's size: what is seen stands where the full-size picture shows it.
TEST(Enlarge, ThingsStayWhereTheyAre) {
    Camera camera;
    camera.fovY = 20;
    const Index2 size(240, 180);
    const Picture full = directions(camera, size);
    for (const Index2 small : {Index2(120, 90), Index2(97, 73), Index2(61, 46), Index2(60, 45)}) {
        const Bytes bytes = enlarged(directions(camera, small), size);
        // Beyond the outermost pixels the picture goes on as it ends.
        for (int y = 6; y < size.y - 6; ++y)
            for (int x = 6; x < size.x - 6; ++x)
                for (int c = 0; c < 2; ++c)
                    ASSERT_NEAR(bytes[std::size_t(4 * ((size.y - 1 - y) * size.x + x) + c)], 255 * full.at(x, y)[c],
                                1.1)
                        << small.x << " at " << x << ", " << y;
    }
}

TEST(Enlarge, IsTheSameForAnyNumberOfThreads) {
    Picture picture({33, 21});
    for (std::size_t n = 0; n < picture.pixels.size(); ++n) picture.pixels[n] = Vec4f(float(n * 37 % 101) / 100);
    setThreadCount(1);
    const Bytes one = enlarged(picture, {200, 150});
    setThreadCount(0);
    EXPECT_EQ(enlarged(picture, {200, 150}), one);
}

}  // namespace
}  // namespace voledit

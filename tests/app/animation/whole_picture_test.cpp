#include "app/animation/whole_picture.h"

#include <gtest/gtest.h>

#include "core/io/io_client.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;

Picture noise(Index2 size) {
    Picture picture(size);
    std::uint32_t state = 1;
    for (Vec4f& pixel : picture.pixels)
        for (int c = 0; c < 4; ++c) pixel[c] = float((state = state * 1664525 + 1013904223) >> 8) / float(1 << 24);
    return picture;
}

TEST(WholePicture, EveryCutIsSeen) {
    const fs::path folder = test::scratchFolder();
    IoClient io;
    for (const char* ending : {".png", ".exr"}) {
        const fs::path file = folder / (std::string("noise") + ending), cut = folder / (std::string("cut") + ending);
        io.writePicture(noise({37, 21}), file);
        EXPECT_TRUE(isWholePicture(file, {37, 21})) << file;
        EXPECT_FALSE(isWholePicture(file, {37, 22})) << file;
        EXPECT_FALSE(isWholePicture(file, {21, 37})) << file;
        const auto bytes = fs::file_size(file);
        for (std::uintmax_t kept = 0; kept < bytes; kept += kept < 600 ? 1 : 13) {
            fs::copy_file(file, cut, fs::copy_options::overwrite_existing);
            fs::resize_file(cut, kept);
            ASSERT_FALSE(isWholePicture(cut, {37, 21})) << cut << " of " << kept << " bytes";
        }
        fs::copy_file(file, cut, fs::copy_options::overwrite_existing);
        fs::resize_file(cut, bytes + 1);
        EXPECT_FALSE(isWholePicture(cut, {37, 21})) << "something follows";
        // As after a crash of the machine: the length is there, the end is not.
        fs::resize_file(cut, bytes / 2);
        fs::resize_file(cut, bytes);
        EXPECT_FALSE(isWholePicture(cut, {37, 21})) << "its second half is zeroes";
    }
    EXPECT_FALSE(isWholePicture(folder / "absent.png", {37, 21}));
}

}  // namespace
}  // namespace voledit

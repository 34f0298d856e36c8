#include <gtest/gtest.h>

#include "tests/core/io/files.h"

namespace voledit {
namespace {

TEST(RawFormat, ReadsAllParts) {
    const RawFormat f = parseRawFormat("256x128x64,int16,1x1x1.5,big");
    EXPECT_EQ(f.size, Index3(256, 128, 64));
    EXPECT_EQ(f.type, VoxelType::Int16);
    EXPECT_EQ(f.spacing, Vec3(1, 1, 1.5));
    EXPECT_TRUE(f.bigEndian);
}

TEST(RawFormat, LeavesPartsOut) {
    const RawFormat f = parseRawFormat("2x3x4,double");
    EXPECT_EQ(f.spacing, Vec3(1));
    EXPECT_FALSE(f.bigEndian);
    EXPECT_TRUE(parseRawFormat("2x3x4,uint8,big").bigEndian);
    EXPECT_EQ(parseRawFormat("2x3x4,uint8,0.5").spacing, Vec3(0.5));
    EXPECT_FALSE(parseRawFormat("2x3x4,uint8,0.5,little").bigEndian);
}

TEST(RawFormat, RefusesTheRest) {
    for (const char* text :
         {"", "2x3x4", "2x3,uint8", "2x3x4x5,uint8", "0x3x4,uint8", "-1x3x4,uint8", "2x3x4,int7", "2x3x4,uint8,0",
          "2x3x4,uint8,-1", "2x3x4,uint8,nan", "2x3x4,uint8,inf", "2x3x4,uint8,1x2", "2x3x4,uint8,1x2x0",
          "2x3x4,uint8,1,huge", "2x3x4,uint8,1,big,more", "99999999999x1x1,uint8", "2x3x4 ,uint8", "2x3x4,uint8,"})
        EXPECT_THROW(parseRawFormat(text), Error) << text;
}

TEST(Raw, ReadsBothByteOrders) {
    const auto folder = test::scratchFolder();
    const auto values = test::counting<std::int16_t>(24, -5);
    IoClient io;
    for (const bool big : {false, true}) {
        const auto path = test::writeFile(folder / (big ? "big.raw" : "little.raw"), test::bytesOf(values, big));
        ReadOptions options;
        options.raw = parseRawFormat(std::string("2x3x4,int16,1x2x3,") + (big ? "big" : "little"));
        const VolumeFile file = io.readVolume(path, options);
        EXPECT_EQ(file.format, "raw");
        EXPECT_EQ(file.volume->grid().spacing(), Vec3(1, 2, 3));
        EXPECT_EQ(test::valuesOf(*file.volume), std::vector<double>(values.begin(), values.end()));
    }
}

TEST(Raw, MustHaveTheSizeThatIsSaid) {
    const auto folder = test::scratchFolder();
    IoClient io;
    ReadOptions options;
    options.raw = parseRawFormat("2x2x2,uint8");
    test::rejection(io, test::writeFile(folder / "short.raw", "1234567"), options);
    const VolumeFile longer = io.readVolume(test::writeFile(folder / "long.raw", "123456789"), options);
    EXPECT_EQ(longer.warnings.size(), 1u);
    test::rejection(io, test::writeFile(folder / "unsaid.raw", "12345678"));
}

}  // namespace
}  // namespace voledit

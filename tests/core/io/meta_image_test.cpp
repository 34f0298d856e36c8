#include <gmock/gmock.h>

#include "tests/core/io/files.h"

namespace voledit {
namespace {

using test::bytesOf;
using test::counting;
using test::valuesOf;

class MetaImage : public testing::Test {
protected:
    VolumeFile read(const std::string& lines, const std::string& data, const std::string& file = "LOCAL") {
        return io_.readVolume(test::writeFile(
            folder_ / "a.mha", "ObjectType = Image\n" + lines + "ElementDataFile = " + file + "\n" + data));
    }

    std::filesystem::path folder_ = test::scratchFolder();
    IoClient io_;
};

const std::string kTwoBytes = "NDims = 3\nDimSize = 2 1 1\nElementType = MET_UCHAR\n";

TEST_F(MetaImage, RowsOfTheMatrixAreAxes) {
    const auto file =
        read(kTwoBytes + "TransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 4 5 6\nElementSpacing = 2 3 0.5\n", "AB");
    const Mat4 expected{{0, 2, 0, 0}, {-3, 0, 0, 0}, {0, 0, 0.5, 0}, {4, 5, 6, 1}};
    EXPECT_EQ(file.volume->grid().worldFromIndex, expected);
}

TEST_F(MetaImage, KnowsOtherNames) {
    const auto file =
        read(kTwoBytes + "Orientation = -1 0 0 0 1 0 0 0 1\nPosition = 4 5 6\nElementSize = 2 2 2\n", "AB");
    EXPECT_EQ(file.volume->grid().worldFromIndex, (Mat4{{-2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 2, 0}, {4, 5, 6, 1}}));
}

TEST_F(MetaImage, ReadsEveryTypeInBothByteOrders) {
    const auto check = [&]<class T>(T, const char* name, VoxelType type) {
        for (const bool big : {false, true}) {
            const auto file = read(std::string("NDims = 3\nDimSize = 2 2 2\nBinaryDataByteOrderMSB = ") +
                                       (big ? "True" : "False") + "\nElementType = " + name + "\n",
                                   bytesOf(counting<T>(8, T(1)), big));
            EXPECT_EQ(file.volume->type(), type) << name;
            EXPECT_EQ(valuesOf(*file.volume), counting<double>(8, 1)) << name;
        }
    };
    check(std::int8_t{}, "MET_CHAR", VoxelType::Int8);
    check(std::uint8_t{}, "MET_UCHAR", VoxelType::UInt8);
    check(std::int16_t{}, "MET_SHORT", VoxelType::Int16);
    check(std::uint16_t{}, "MET_USHORT", VoxelType::UInt16);
    check(std::int32_t{}, "MET_INT", VoxelType::Int32);
    check(std::uint32_t{}, "MET_UINT", VoxelType::UInt32);
    check(std::int32_t{}, "MET_LONG", VoxelType::Int32);  // four bytes, by MetaIO's table
    check(std::int64_t{}, "MET_LONG_LONG", VoxelType::Double);
    check(float{}, "MET_FLOAT", VoxelType::Float);
    check(double{}, "MET_DOUBLE", VoxelType::Double);
}

TEST_F(MetaImage, ReadsTextAndPackedData) {
    EXPECT_EQ(valuesOf(*read(kTwoBytes + "BinaryData = False\n", "7 200\n").volume), (std::vector<double>{7, 200}));
    const std::string packed = test::gzipped("AB");
    EXPECT_EQ(valuesOf(*read(kTwoBytes + "CompressedData = True\n", packed).volume), (std::vector<double>{65, 66}));
}

TEST_F(MetaImage, ReadsChannelsTimeStepsAndFewerDimensions) {
    const auto rgb = read("NDims = 2\nDimSize = 2 1\nElementNumberOfChannels = 3\nElementType = MET_UCHAR\n", "abcdef");
    EXPECT_EQ(rgb.volume->grid().channels, 3);
    EXPECT_EQ(valuesOf(*rgb.volume), counting<double>(6, 97));
    const auto steps = read("NDims = 4\nDimSize = 2 1 1 3\nElementType = MET_UCHAR\n", "abcdef");
    EXPECT_EQ(valuesOf(*steps.volume), counting<double>(2, 97));
    EXPECT_EQ(steps.warnings.size(), 1u);
}

TEST_F(MetaImage, FindsItsData) {
    test::writeFile(folder_ / "one.raw", "xxAB");
    test::writeFile(folder_ / "s1.raw", "A");
    test::writeFile(folder_ / "s2.raw", "B");
    const std::vector<double> ab{65, 66};
    EXPECT_EQ(valuesOf(*read(kTwoBytes + "HeaderSize = -1\n", "", "one.raw").volume), ab);
    EXPECT_EQ(valuesOf(*read(kTwoBytes + "HeaderSize = 2\n", "", "one.raw").volume), ab);
    EXPECT_EQ(valuesOf(*read(kTwoBytes, "", "s%d.raw 1 2 1").volume), ab);
    EXPECT_EQ(valuesOf(*read(kTwoBytes, "s1.raw\ns2.raw\n", "LIST").volume), ab);
    // "LIST 2" tells the dimensions of each file.
    EXPECT_EQ(valuesOf(*read(kTwoBytes, "s1.raw\ns2.raw\n", "LIST 2").volume), ab);
}

TEST_F(MetaImage, AppliesSlopeAndOffset) {
    const auto file =
        read(kTwoBytes + "ElementToIntensityFunctionSlope = 2\nElementToIntensityFunctionOffset = -1000\n", "AB");
    EXPECT_EQ(valuesOf(*file.volume), (std::vector<double>{-870, -868}));
    EXPECT_EQ(file.volume->type(), VoxelType::Int16);
}

}  // namespace
}  // namespace voledit
